// SPDX-License-Identifier: MIT
#include "tests/reference/environments/solid.h"

#include <cmath>
#include <limits>

namespace lsys::reference {

namespace {

// (a x + b y + c z) + d
double height_above(const Plane& plane, const Vector& place) {
    return ((plane[0] * place[0] + plane[1] * place[1]) + plane[2] * place[2]) + plane[3];
}

std::vector<double> nearest_of_planes(const std::vector<Plane>& planes, const Vector& place) {
    std::vector<double> nearest = {std::numeric_limits<double>::infinity(), 0, 0, 0};
    for (const Plane& plane : planes) {
        const Vector normal{plane[0], plane[1], plane[2]};
        const double length = length_of(normal);
        const double height = height_above(plane, place);
        const double distance = std::fabs(height) / length;
        if (distance < nearest[0]) {
            nearest = {distance};
            for (const double component : normal) {
                nearest.push_back(height > 0   ? -component / length
                                  : height < 0 ? component / length
                                               : 0.0);
            }
        }
    }
    return nearest;
}

} // namespace

std::vector<double> nearest_of_meshes(const std::vector<Surface>& meshes, const Vector& place) {
    Vector nearest{};
    double least = std::numeric_limits<double>::infinity();
    double greatest = 0; // magnitude of a coordinate
    const auto see = [&greatest](const Vector& point) {
        for (const double coordinate : point) {
            greatest = std::fmax(greatest, std::fabs(coordinate));
        }
    };
    see(place);
    for (const Surface& mesh : meshes) {
        for (const Triangle& triangle : mesh) {
            for (const Vector& corner : triangle) {
                see(corner);
            }
            const Vector way = way_to(triangle, place);
            if (has_area(triangle) && dot(way, way) < least) {
                nearest = way;
                least = dot(way, way);
            }
        }
    }
    double distance = std::sqrt(least);
    if (distance <= std::ldexp(greatest, -48)) { // "a place on the mesh"
        distance = 0;
    }
    std::vector<double> answer = {distance};
    for (const double component : nearest) {
        answer.push_back(distance > 0 ? component / distance : 0.0);
    }
    return answer;
}

Answers solid_answers(const Solid& solid, const std::vector<Place>& places) {
    std::vector<Surface> bounds; // the closed meshes, which have an inside
    for (const Surface& mesh : solid.meshes) {
        if (is_closed(mesh)) {
            bounds.push_back(oriented(mesh));
        }
    }
    Answers answers;
    for (const Place& place : places) {
        std::vector<double> answer = nearest_of_planes(solid.planes, place.position);
        const std::vector<double> of_meshes = nearest_of_meshes(solid.meshes, place.position);
        if (of_meshes[0] < answer[0]) {
            answer = of_meshes;
        }
        bool is_inside = false;
        for (const Plane& plane : solid.planes) {
            is_inside = is_inside || height_above(plane, place.position) < 0;
        }
        for (const Surface& bound : bounds) {
            is_inside = is_inside || winding_number(bound, place.position) != 0;
        }
        answer[0] = is_inside ? -answer[0] : answer[0];
        answers.push_back(answer);
    }
    return answers;
}

} // namespace lsys::reference
