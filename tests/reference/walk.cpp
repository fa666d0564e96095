// SPDX-License-Identifier: MIT
#include "tests/reference/walk.h"

#include "tests/reference/environments/exact.h"
#include "tests/reference/mesh_file.h"

#include <algorithm>
#include <cstdlib>

namespace lsys::reference {

namespace {

// Turns a towards b: a' = c a + s b, b' = c b - s a.
void turn(Vector& a, Vector& b, const SineCosine& angle) {
    const Vector first = a;
    const Vector second = b;
    for (std::size_t i = 0; i < 3; ++i) {
        a[i] = angle.cosine * first[i] + angle.sine * second[i];
        b[i] = angle.cosine * second[i] - angle.sine * first[i];
    }
}

// Rotates about the axis k (Rodrigues): v' = (v c + (k x v) s) + k ((k . v) (1 - c)).
void rotate(Vector& v, const Vector& k, const SineCosine& angle) {
    const Vector aside = cross(k, v);
    const double along = dot(k, v) * (1.0 - angle.cosine);
    for (std::size_t i = 0; i < 3; ++i) {
        v[i] = (v[i] * angle.cosine + aside[i] * angle.sine) + k[i] * along;
    }
}

// An open polygon.
struct Polygon {
    std::vector<Vector> points; // of `.`
    std::vector<Vector> path;   // starts and ends of `F` and `f`; equal successive points once
};

// "In a polygon without any `.`, the start and the end of every `F` and `f` are its vertices. A last
// vertex equal to the first is omitted."
std::vector<Vector> corners_of(const Polygon& polygon) {
    if (!polygon.points.empty()) {
        return polygon.points;
    }
    std::vector<Vector> corners = polygon.path;
    if (corners.size() > 2) {
        const double side = length_of(difference(corners[0], corners[1]));
        if (length_of(difference(corners.front(), corners.back())) <= 1e-5 * side) {
            corners.pop_back();
        }
    }
    return corners;
}

// A polygon as an organ: half the length of Newell's vector as area, the mean corner as middle.
Organ organ_of(const std::vector<Vector>& corners) {
    Organ organ;
    Vector normal{};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector& a = corners[i];
        const Vector& b = corners[(i + 1) % corners.size()];
        normal[0] += (a[1] - b[1]) * (a[2] + b[2]);
        normal[1] += (a[2] - b[2]) * (a[0] + b[0]);
        normal[2] += (a[0] - b[0]) * (a[1] + b[1]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            organ.middle[axis] += a[axis];
        }
    }
    for (double& coordinate : organ.middle) {
        coordinate /= static_cast<double>(corners.size());
    }
    organ.area = length_of(normal) / 2;
    return organ;
}

class Walker {
public:
    explicit Walker(const System& system)
        : system_(system), turtle_(setting(*system.grammar, "turtle").value_or("lsys")),
          angle_(number_setting("angle", 90)), step_scale_(number_setting("step_scale", 0.9F)) {
        now_.step = static_cast<double>(number_setting("step", 1));
        if (const auto text = setting(*system.grammar, "tropism")) {
            const char* at = text->c_str();
            for (double& number : tropism_) {
                char* end = nullptr;
                number = static_cast<double>(std::strtof(at, &end));
                at = end;
            }
        }
    }

    [[nodiscard]] const Pose& pose() const { return now_.pose; }
    [[nodiscard]] const std::vector<Organ>& organs() const { return organs_; }

    // Follows a module. Returns a failure for a `]` or `}` without its opening bracket.
    std::optional<Failure> follow(const Module& module) {
        const std::string& name = module.name;
        const auto object = system_.objects.find(name);
        if (name == "[") {
            stack_.push_back(now_);
        } else if (name == "]") {
            if (stack_.empty()) {
                return Failure::UnmatchedBracket;
            }
            now_ = stack_.back();
            stack_.pop_back();
        } else if (name == "{") {
            polygons_.emplace_back();
        } else if (name == "}") {
            return close_polygon();
        } else if (object != system_.objects.end()) {
            draw_object(*object->second, module);
        } else if (name == ".") {
            if (!polygons_.empty()) {
                polygons_.back().points.push_back(now_.pose.position);
            }
        } else if (name == "F" || name == "f") {
            advance(module, name == "F");
        } else {
            turn_by(module);
        }
        return std::nullopt;
    }

private:
    struct State {
        Pose pose;
        double step = 1;
    };

    [[nodiscard]] float number_setting(const std::string& key, float usual) const {
        const std::optional<std::string> text = setting(*system_.grammar, key);
        return text ? std::strtof(text->c_str(), nullptr) : usual;
    }

    static double parameter(const Module& module, double usual) {
        return module.values.empty() ? usual : static_cast<double>(module.values[0]);
    }

    void move(double length) {
        for (std::size_t i = 0; i < 3; ++i) {
            now_.pose.position[i] += length * now_.pose.heading[i];
        }
    }

    void advance(const Module& module, bool draws) {
        if (draws) {
            bend();
        }
        add_corner();
        move(parameter(module, now_.step));
        add_corner();
    }

    void add_corner() {
        if (polygons_.empty()) {
            return;
        }
        std::vector<Vector>& path = polygons_.back().path;
        if (path.empty() || path.back() != now_.pose.position) {
            path.push_back(now_.pose.position);
        }
    }

    // "Every drawn segment first turns H by the angle e |H x T| (radians) towards T."
    void bend() {
        const Vector axis = cross(now_.pose.heading, {tropism_[0], tropism_[1], tropism_[2]});
        const double length = length_of(axis);
        if (length == 0 || tropism_[3] == 0) {
            return;
        }
        const SineCosine angle = sine_cosine_of_radians(tropism_[3] * length);
        for (Vector* v : {&now_.pose.heading, &now_.pose.right, &now_.pose.up}) {
            rotate(*v, unit(axis), angle);
        }
    }

    void turn_by(const Module& module) {
        Pose& pose = now_.pose;
        const bool thesis = turtle_ == "thesis";
        const SineCosine angle =
            sine_cosine_of_degrees(parameter(module, static_cast<double>(angle_)));
        const SineCosine back = {-angle.sine, angle.cosine};
        const std::string& name = module.name;
        if (name == "+" || name == "-") {
            const bool to_the_right = (name == "+") != (turtle_ == "abop");
            turn(pose.heading, pose.right, to_the_right ? angle : back);
        } else if (name == (thesis ? "/" : "^")) { // pitch up
            turn(pose.heading, pose.up, angle);
        } else if (name == (thesis ? "\\" : "&")) { // pitch down
            turn(pose.heading, pose.up, back);
        } else if (name == (thesis ? "&" : "\\")) { // roll left: R towards U
            turn(pose.right, pose.up, angle);
        } else if (name == (thesis ? "^" : "/")) { // roll right
            turn(pose.right, pose.up, back);
        } else if (name == "|" && !thesis) {
            turn(pose.heading, pose.right, sine_cosine_of_degrees(180));
        } else if (name == "$" && !thesis) {
            roll_upright();
        } else if (name == "\"" && !thesis) {
            now_.step *= parameter(module, static_cast<double>(step_scale_));
        }
    }

    // R = H x Y / |H x Y|
    void roll_upright() {
        Pose& pose = now_.pose;
        const Vector right = cross(pose.heading, {0, 1, 0});
        if (length_of(right) > 1e-9) {
            pose.right = unit(right);
            pose.up = cross(pose.right, pose.heading);
        }
    }

    std::optional<Failure> close_polygon() {
        if (polygons_.empty()) {
            return Failure::UnmatchedPolygon;
        }
        const std::vector<Vector> corners = corners_of(polygons_.back());
        polygons_.pop_back();
        if (corners.size() > 2) {
            organs_.push_back(organ_of(corners));
        }
        return std::nullopt;
    }

    void draw_object(const Statement& object, const Module& module) {
        if (object.text == "BRANCH") {
            advance(module, true);
            return;
        }
        constexpr double kDisk = 3.14159265358979323846 / 4;
        static const std::map<std::string, double> kAreas = {
            {"SPHERE", kDisk}, {"HETEROCYST", kDisk}, {"DISK", kDisk},
            {"CUBE", 1},       {"CYLINDER", 1},       {"CONE", 0.5}};
        const double scale = parameter(module, 1);
        double area = 0; // at scale 1
        double length = object.text == "DISK" ? 0 : 1;
        if (object.mesh.empty()) {
            const auto found = kAreas.find(object.text);
            area = found == kAreas.end() ? 0 : found->second;
        } else {
            const MeshFile& mesh = mesh_of(*system_.grammar, object.mesh);
            area = half_area(mesh);
            length = length_of_object(mesh);
        }
        length *= scale;
        Organ organ{now_.pose.position, area * (scale * scale)};
        for (std::size_t i = 0; i < 3; ++i) {
            organ.middle[i] += length / 2 * now_.pose.heading[i];
        }
        organs_.push_back(organ);
        move(length);
    }

    const System& system_;
    std::string turtle_;
    float angle_;
    float step_scale_;
    std::array<double, 4> tropism_{}; // T, e
    State now_;
    std::vector<State> stack_;
    std::vector<Polygon> polygons_;
    std::vector<Organ> organs_;
};

} // namespace

Walk walk(const System& system, const Word& word, const Word& drawn, std::uint32_t age) {
    Walk result;
    Walker walker(system);
    std::size_t next = 0;
    for (std::size_t i = 0; i < word.size(); ++i) {
        if (is_sense_name(word[i].name)) {
            result.poses[i] = walker.pose();
        }
        for (; next < drawn.size() && drawn[next].source == i; ++next) {
            if (const auto failure = walker.follow(drawn[next])) {
                throw Stop{RunError{*failure, "", i, age, word[i]}};
            }
        }
    }
    result.organs = walker.organs();
    return result;
}

} // namespace lsys::reference
