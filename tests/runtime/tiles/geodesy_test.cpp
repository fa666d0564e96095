// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/geodesy.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <numbers>

namespace lsys {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

double degrees(double whole, double minutes, double seconds) {
    return whole + minutes / 60.0 + seconds / 3600.0;
}

/// Latitude in radians and height above the ellipsoid, by iteration.
std::pair<double, double> latitude_and_height(const glm::dvec3& point) {
    constexpr double kA = 6378137.0;
    constexpr double kE2 = 6.69437999014e-3;
    const double from_axis = std::hypot(point.x, point.y);
    double latitude = std::atan2(point.z, from_axis * (1.0 - kE2));
    double height = 0.0;
    for (int i = 0; i < 20; ++i) {
        const double normal = kA / std::sqrt(1.0 - kE2 * std::pow(std::sin(latitude), 2));
        height = from_axis * std::cos(latitude) + point.z * std::sin(latitude) - kA * kA / normal;
        latitude = std::atan2(point.z, from_axis * (1.0 - kE2 * normal / (normal + height)));
    }
    return {latitude, height};
}

TEST_CASE("the end of a geodesic is that of the line Flinders Peak - Buninyong") {
    // Test data of Geoscience Australia for Vincenty's formulas, on GRS 80.
    const GeoPlace flinders{degrees(144, 25, 29.52440), -degrees(37, 57, 3.72030), 0.0};
    const double azimuth = degrees(306, 52, 5.37) * kDegree;
    const GeoPlace end = along_geodesic(flinders, std::sin(azimuth), std::cos(azimuth), 54'972.271);
    constexpr double kMillimetre = 1e-3 / 111e3; // in degrees
    CHECK(end.latitude == Approx(-degrees(37, 39, 10.15610)).margin(kMillimetre));
    CHECK(end.longitude == Approx(degrees(143, 55, 35.38390)).margin(kMillimetre));
}

TEST_CASE("meridians and the equator are geodesics") {
    // A quarter of the meridian of WGS 84: 10,001,965.729 m.
    const GeoPlace pole = along_geodesic({10.0, 0.0, 5.0}, 0.0, 1.0, 10'001'965.729);
    CHECK(pole.latitude == Approx(90.0).margin(1e-7));
    CHECK(pole.height == 5.0);
    const GeoPlace east = along_geodesic({0.0, 0.0, 0.0}, 1.0, 0.0, 6378137.0 * kDegree);
    CHECK(east.longitude == Approx(1.0).margin(1e-9));
    CHECK(east.latitude == Approx(0.0).margin(1e-9));
}

TEST_CASE("earth-fixed coordinates are those of the ellipsoid") {
    const glm::dvec3 pole = earth_fixed({77.0, 90.0, 100.0});
    CHECK(pole.z == Approx(6356752.3142 + 100.0).margin(1e-3));
    CHECK(std::hypot(pole.x, pole.y) < 1e-6);
    const glm::dvec3 equator = earth_fixed({90.0, 0.0, 0.0});
    CHECK(equator.y == Approx(6378137.0).margin(1e-6));
}

TEST_CASE("heights follow the ellipsoid to the corners of a scene of 316 km") {
    const GroundFrame earth(GeoPlace{9.7, 47.2, 430.0});
    for (const double x : {0.0, 100'000.0, 316'000.0}) {
        for (const double z : {0.0, -316'000.0, 316'000.0}) {
            const auto [latitude, height] = latitude_and_height(earth.place(x, 12.5, z));
            CHECK(height == Approx(442.5).margin(1e-3));
        }
    }
}

TEST_CASE("a frame stands upright, and its axes point east and north") {
    const GroundFrame earth(GeoPlace{9.7, 47.2, 430.0});
    for (const double x : {0.0, 50'000.0}) {
        const glm::dmat4 frame = earth.frame(x, -20'000.0);
        const glm::dmat3 axes(frame);
        const glm::dmat3 product = glm::transpose(axes) * axes;
        for (int i = 0; i < 3; ++i) {
            for (int k = 0; k < 3; ++k) {
                CHECK(product[i][k] == Approx(i == k ? 1.0 : 0.0).margin(1e-12));
            }
        }
        const glm::dmat4 inverse = inverse_of_frame(frame);
        const auto local = [&](double east, double up, double south) {
            return glm::dvec3(inverse *
                              glm::dvec4(earth.place(x + east, up, -20'000.0 + south), 1.0));
        };
        // Away from the origin, the scene's -Z is not exactly north, so the bounds are wide.
        CHECK(local(0.0, 7.0, 0.0).z == Approx(7.0).margin(1e-6));
        CHECK(glm::length(local(10.0, 0.0, 0.0)) == Approx(10.0).epsilon(1e-4));
        CHECK(local(10.0, 0.0, 0.0).x > 9.9);
        CHECK(local(0.0, 0.0, -10.0).y > 9.9);
    }
}

TEST_CASE("without an origin a tileset has the coordinates of the scene") {
    const GroundFrame plain(std::nullopt);
    CHECK(plain.place(1.0, 2.0, 3.0) == glm::dvec3(1.0, -3.0, 2.0));
    CHECK(glm::dvec3(plain.frame(4.0, 5.0)[3]) == glm::dvec3(4.0, -5.0, 0.0));
}

TEST_CASE("the interpolated frame of a tile is exact to 2 mm") {
    for (const double latitude : {-89.9999, 0.0, 47.2}) {
        const GroundFrame earth(GeoPlace{9.7, latitude, 430.0});
        for (const double side : {60.0, 2000.0, kMaxInterpolatedSide}) {
            const Region region{-15e4, 7e4, side, 0.7 * side};
            const glm::dmat4 to_tile = inverse_of_frame(earth.frame(region.x, region.z));
            const TileFrame frame(earth, to_tile, region);
            for (const double part : {0.0, 0.21, 0.5, 0.83, 1.0}) {
                const double x = region.x + part * region.width;
                const double z = region.z + (1.0 - part * part) * region.depth;
                const glm::dvec3 exact(to_tile * glm::dvec4(earth.place(x, 800.0, z), 1.0));
                CAPTURE(latitude, side, part);
                CHECK(glm::length(frame.place(x, 800.0, z) - exact) < 2e-3);
            }
        }
    }
}

} // namespace
} // namespace lsys
