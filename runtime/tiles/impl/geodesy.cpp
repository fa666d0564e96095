// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/geodesy.h"

#include "grammar/base/trigonometry.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lsys {

namespace {

constexpr double kA = 6378137.0;           // m, semi-major axis of WGS 84
constexpr double kF = 1.0 / 298.257223563; // flattening
constexpr double kB = kA * (1.0 - kF);     // m, semi-minor axis
constexpr double kE2 = kF * (2.0 - kF);    // square of the eccentricity
constexpr double kDegree = std::numbers::pi / 180.0;

} // namespace

glm::dvec3 earth_fixed(const GeoPlace& place) {
    const auto [sin_lat, cos_lat] = sine_cosine(place.latitude * kDegree);
    const auto [sin_lon, cos_lon] = sine_cosine(place.longitude * kDegree);
    // Radius of curvature in the prime vertical, m.
    const double prime_vertical = kA / std::sqrt(1.0 - kE2 * sin_lat * sin_lat);
    return {(prime_vertical + place.height) * cos_lat * cos_lon,
            (prime_vertical + place.height) * cos_lat * sin_lon,
            (prime_vertical * (1.0 - kE2) + place.height) * sin_lat};
}

GeoPlace along_geodesic(const GeoPlace& start, double east, double north, double distance) {
    if (distance == 0.0) {
        return start;
    }
    const auto [sin_lat, cos_lat] = sine_cosine(start.latitude * kDegree);
    // Reduced latitude of the start.
    const double length =
        std::sqrt((1.0 - kF) * (1.0 - kF) * sin_lat * sin_lat + cos_lat * cos_lat);
    const double sin_u = (1.0 - kF) * sin_lat / length;
    const double cos_u = cos_lat / length;
    const double sigma_1 = polar_angle(sin_u, cos_u * north);
    const double sin_alpha = cos_u * east; // sine of the azimuth at the equator
    const double cos2_alpha = 1.0 - sin_alpha * sin_alpha;
    const double u2 = cos2_alpha * (kA * kA - kB * kB) / (kB * kB);
    const double a = 1.0 + u2 / 16384.0 * (4096.0 + u2 * (-768.0 + u2 * (320.0 - 175.0 * u2)));
    const double b = u2 / 1024.0 * (256.0 + u2 * (-128.0 + u2 * (74.0 - 47.0 * u2)));
    double sigma = distance / (kB * a);
    SineCosine at;
    double cos_2m = 0.0;      // cosine of twice the angle from the equator to the middle
    constexpr int kSteps = 8; // each makes the correction 300 times smaller
    for (int i = 0; i < kSteps; ++i) {
        at = sine_cosine(sigma);
        cos_2m = sine_cosine(2.0 * sigma_1 + sigma).cosine;
        const double square = cos_2m * cos_2m;
        const double change = b * at.sine *
                              (cos_2m + b / 4.0 *
                                            (at.cosine * (2.0 * square - 1.0) -
                                             b / 6.0 * cos_2m * (4.0 * at.sine * at.sine - 3.0) *
                                                 (4.0 * square - 3.0)));
        const double next = distance / (kB * a) + change;
        if (next == sigma) {
            break; // further steps would not change it
        }
        sigma = next;
    }
    at = sine_cosine(sigma);
    cos_2m = sine_cosine(2.0 * sigma_1 + sigma).cosine;
    const double across = sin_u * at.sine - cos_u * at.cosine * north;
    const double latitude =
        polar_angle(sin_u * at.cosine + cos_u * at.sine * north,
                    (1.0 - kF) * std::sqrt(sin_alpha * sin_alpha + across * across));
    const double lambda = polar_angle(at.sine * east, cos_u * at.cosine - sin_u * at.sine * north);
    const double c = kF / 16.0 * cos2_alpha * (4.0 + kF * (4.0 - 3.0 * cos2_alpha));
    const double turn =
        lambda -
        (1.0 - c) * kF * sin_alpha *
            (sigma + c * at.sine * (cos_2m + c * at.cosine * (2.0 * cos_2m * cos_2m - 1.0)));
    return {start.longitude + turn / kDegree, latitude / kDegree, start.height};
}

GeoPlace GroundFrame::geographic(double x, double z) const {
    const double distance = std::sqrt(x * x + z * z);
    return distance == 0.0 ? *origin_
                           : along_geodesic(*origin_, x / distance, -z / distance, distance);
}

glm::dvec3 GroundFrame::place(double x, double y, double z) const {
    if (!origin_) {
        return {x, -z, y};
    }
    GeoPlace at = geographic(x, z);
    at.height += y;
    return earth_fixed(at);
}

glm::dmat4 GroundFrame::frame(double x, double z) const {
    glm::dmat4 axes(1.0);
    if (!origin_) {
        axes[3] = glm::dvec4(x, -z, 0.0, 1.0);
        return axes;
    }
    const GeoPlace at = geographic(x, z);
    const auto [sin_lat, cos_lat] = sine_cosine(at.latitude * kDegree);
    const auto [sin_lon, cos_lon] = sine_cosine(at.longitude * kDegree);
    axes[0] = {-sin_lon, cos_lon, 0.0, 0.0};
    axes[1] = {-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat, 0.0};
    axes[2] = {cos_lat * cos_lon, cos_lat * sin_lon, sin_lat, 0.0};
    axes[3] = glm::dvec4(earth_fixed(at), 1.0);
    return axes;
}

TileFrame::TileFrame(const GroundFrame& earth, const glm::dmat4& to_tile, const Region& region)
    : earth_(earth), to_tile_(to_tile), region_(region),
      is_interpolated_(earth.is_curved() &&
                       std::max(region.width, region.depth) <= kMaxInterpolatedSide) {
    for (std::size_t i = 0; is_interpolated_ && i < nodes_.size(); ++i) {
        const auto column = static_cast<double>(i % kNodes);
        const auto row = static_cast<double>(i / kNodes);
        nodes_[i] = exact_place(region.x + region.width * column / (kNodes - 1),
                                region.z + region.depth * row / (kNodes - 1));
    }
}

glm::dvec3 TileFrame::exact(double x, double y, double z) const {
    return glm::dvec3(to_tile_ * glm::dvec4(earth_.place(x, y, z), 1.0));
}

TileFrame::Place TileFrame::exact_place(double x, double z) const {
    constexpr double kRise = 1024.0; // m; places depend linearly on the altitude
    const glm::dvec3 foot = exact(x, 0.0, z);
    return {foot, (exact(x, kRise, z) - foot) / kRise};
}

TileFrame::Place TileFrame::at(double x, double z) const {
    if (!is_interpolated_) {
        return exact_place(x, z);
    }
    // The three polynomials of degree 2 that are 1 at one of the nodes 0, 1/2 and 1, and 0 at the
    // others.
    const auto weights = [](double t) {
        return std::array<double, kNodes>{(1.0 - t) * (1.0 - 2.0 * t), 4.0 * t * (1.0 - t),
                                          t * (2.0 * t - 1.0)};
    };
    const std::array<double, kNodes> along_x = weights((x - region_.x) / region_.width);
    const std::array<double, kNodes> along_z = weights((z - region_.z) / region_.depth);
    Place place;
    for (std::size_t row = 0; row < kNodes; ++row) {
        for (std::size_t column = 0; column < kNodes; ++column) {
            const double weight = along_x[column] * along_z[row];
            const Place& node = nodes_[row * kNodes + column];
            place.foot += weight * node.foot;
            place.up += weight * node.up;
        }
    }
    return place;
}

glm::dvec3 TileFrame::place(double x, double y, double z) const {
    if (!is_interpolated_) {
        return exact(x, y, z);
    }
    const Place place = at(x, z);
    return place.foot + y * place.up;
}

glm::dmat4 inverse_of_frame(const glm::dmat4& frame) {
    const glm::dmat3 turned = glm::transpose(glm::dmat3(frame));
    glm::dmat4 inverse(turned);
    inverse[3] = glm::dvec4(-(turned * glm::dvec3(frame[3])), 1.0);
    return inverse;
}

} // namespace lsys
