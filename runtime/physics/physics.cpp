// SPDX-License-Identifier: MIT
// Spring-joint physics of plants: Crankshaw 2019, chapter 6, after Barron, Sorge and Davis 2001,
// "Real-time procedural animation of trees". As in both works, a segment turns about its base against
// a spring and a damper, moved by weight and wind, and carries its children. Differences:
// - Hooke's torque is -k d - c w with the relative angular velocity w. The thesis prints + for the
//   damper, which would add energy.
// - Wind is a velocity in m/s. Its force on a segment is 1/2 rho C A |v| v: v is the velocity of
//   the air relative to the segment, A the area that faces the wind. Still air therefore slows
//   motion down. Torque is lever x force as in the thesis.
// - The weight and the inertia of the crown act on the trunk: all joints are solved together.
//
// A step is implicit (impl/joints.cpp). This alone does not prove stability: rotations are not
// linear, and centrifugal terms are explicit. So the result of a step is also checked. Let E be the
// allowed energy, initially the energy at the start.
//   1. Take the solved motion for the whole step, else for a quarter, a sixteenth ... of it: the
//      first part whose potential energy V (springs and weight) is at most E.
//   2. If there is none, stand still in this step: V, which is at most E, does not change.
//   3. If V + kinetic energy exceeds E, scale velocities down so that the sum equals E.
//   4. Set E to this sum.
// Kinetic energy is never negative, so V + kinetic energy never grows, for any grammar and any
// error of the solver; with wind, it grows by no more than the work of the wind. Sums of doubles
// are exact up to rounding: V may exceed E by 1e-12 of the magnitudes of its terms, but not by more
// in later steps, as E itself never rises. Item 1 nearly always takes the whole step: the solver
// minimises an upper bound of the energy (impl/joints.cpp). Implicit Euler damps motions that are
// too fast for the time step.
//
// The ground is part of V: a spring under each tip that is above the ground at rest, with energy 0
// at rest. pose() raises tips that the springs leave in the ground (impl/ground.h). Friction brakes
// tips that slide, so it takes energy.
//
// With LoadRule::Own a joint moves as if its segment stood alone on its parent; V counts weights
// at bases that stand still. settle() then solves joint by joint, from the root to the tips.
//
// settle() takes long steps, each from standstill and without dampers. Each step lowers the energy.
// Near the end, steps use more of the true second derivative of the energy; the last steps are
// Newton's method, which doubles the number of correct digits per round. settle() leaves out the
// friction of the ground, and stops where friction would hold the plant.
//
// A large plant that falls is settled in stages (nested iteration; Trottenberg et al. 2001, section
// 2.6): first its main branches, with point masses in place of twigs, or a long curve as a chain of
// rigid pieces (impl/coarse.h); then more and more of the plant. Each stage starts from the pose of
// the stage before it. Thus most rounds, which find the final direction of branches, are cheap, and
// only few rounds move all bodies. The start of the last stage may have more energy than the plant
// had before, because the twigs have not moved yet. If the energy is still higher at rest, settle()
// discards the result and settles without stages, so that the energy never grows.
#include "runtime/physics/physics.h"

#include "grammar/base/trigonometry.h"
#include "runtime/physics/impl/coarse.h"
#include "runtime/physics/impl/ground.h"
#include "runtime/physics/impl/motion.h"
#include "runtime/physics/impl/rotation.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

namespace lsys {

namespace {

constexpr double kDragCoefficient = 1.1; // approximate value of long cylinders and of plates
constexpr double kFriction = 0.5;        // approximate value of bark on soil
constexpr int kTrials = 12;              // max number of fractions of a step that are tried
constexpr int kExactTrials = 2;          // replaces kTrials if Forces::exactness > 0
constexpr double kTrialRatio = 0.25;     // ratio of a tried fraction to the fraction tried before
constexpr double kRounding = 1e-12;      // relative to Energies::potential_magnitude
constexpr double kSettleStep = 1e6;      // s, step of settle(), so long that inertia is negligible
// A plant that slides in settle() is at rest when friction with this coefficient, lower than that
// of ice, would stop it: the energy lost in about the last ten rounds is compared with the work of
// friction in these rounds. Each round multiplies the weight of older rounds by kRememberedShare.
constexpr double kRestFriction = 0.03;
constexpr double kRememberedShare = 0.9;
// In a stage after the first, with at least kManyBodies bodies, main branches already lie on the
// ground. The plant is then at rest when it lost less energy in the last kStageRounds rounds than
// friction with these coefficients would take. A long curve falls into a heap that continues to
// roll and slide a little; real friction (kFriction) would stop this motion.
constexpr std::size_t kManyBodies = 10'000;
constexpr double kStageFriction = 0.1;      // in all stages but the last
constexpr double kLastStageFriction = 0.25; // in the last stage
constexpr std::size_t kStageRounds = 3;
// A plant counts as falling, and is then settled in stages, which is faster, if one of the first
// kFallingRounds rounds turns a body by kFallingTurn, or if the plant is not at rest after these
// rounds.
constexpr double kFallingTurn = 0.3; // rad
constexpr std::uint32_t kFallingRounds = 12;
// Max number of rounds of a stage other than the last: as many as take the time of kStageWork
// rounds of the whole plant, but at most kMaxStageRounds.
constexpr std::size_t kStageWork = 8;
constexpr std::size_t kMaxStageRounds = 200;

/// Weight, 0 to 1, of the upper bounds of the second derivatives in a round of settle(): 1 -
/// Forces::exactness. It is lowered after complete steps and raised after a shortened step. If the
/// step after it was lowered is shortened, more complete steps are needed before it is lowered
/// again.
class BoundWeight {
public:
    [[nodiscard]] double value() const { return value_; }

    /// `whole`: whether the step of the last round was complete.
    void update(bool whole) {
        if (whole) {
            patience_ = was_lowered_ ? 1 : patience_;
            was_lowered_ = ++whole_steps_ >= patience_;
            if (was_lowered_) {
                whole_steps_ = 0;
                value_ = value_ > kMin ? 0.5 * value_ : 0.0;
            }
        } else {
            patience_ = was_lowered_ ? std::min(2 * patience_, kMaxPatience) : patience_;
            was_lowered_ = false;
            whole_steps_ = 0;
            value_ = std::clamp(4.0 * value_, kMin, 1.0);
        }
    }

private:
    static constexpr double kMin = 1e-3; // min value above 0
    static constexpr int kMaxPatience = 16;
    double value_ = 1.0;
    int whole_steps_ = 0;      // complete steps since the value changed
    int patience_ = 1;         // complete steps before the value is lowered
    bool was_lowered_ = false; // whether the value was lowered in the last round
};

/// Compares the energy lost in the last rounds of settle() with the work of friction on the ground.
class RecentRounds {
public:
    /// `is_large_late_stage`: whether this is a stage after the first, with at least kManyBodies
    /// bodies; `is_last`: whether no stage follows.
    RecentRounds(bool is_large_late_stage, bool is_last)
        : is_large_late_stage_(is_large_late_stage),
          stage_friction_(is_last ? kLastStageFriction : kStageFriction) {}

    void add(double share, double energy_loss, double slide) {
        if (!is_large_late_stage_) {
            energy_loss_ = kRememberedShare * energy_loss_ + energy_loss;
            slide_ = kRememberedShare * slide_ + slide;
        } else if (share > 0.0) {
            energy_losses_[count_ % kStageRounds] = energy_loss;
            slides_[count_ % kStageRounds] = slide;
            ++count_;
        }
    }

    /// Whether friction would hold the plant.
    [[nodiscard]] bool is_held() const {
        return is_large_late_stage_ ? count_ >= kStageRounds &&
                                          sum_of(energy_losses_) < stage_friction_ * sum_of(slides_)
                                    : energy_loss_ < kRestFriction * slide_;
    }

private:
    using Last = std::array<double, kStageRounds>;

    static double sum_of(const Last& last) {
        return std::accumulate(last.begin(), last.end(), 0.0);
    }

    bool is_large_late_stage_;
    double stage_friction_;
    double energy_loss_ = 0.0; // J, decaying sum over all rounds
    double slide_ = 0.0;       // J, decaying sum of Energies::slide
    Last energy_losses_{};     // J, of the last rounds that moved the plant
    Last slides_{};            // J, Energies::slide of these rounds
    std::size_t count_ = 0;    // rounds that moved the plant
};

float finite_or(float value, float other) {
    return std::isfinite(value) ? value : other;
}
float not_negative(float value) {
    return std::max(finite_or(value, 0.0F), 0.0F);
}

/// The options, with values out of range replaced.
PhysicsOptions usable(PhysicsOptions options) {
    options.gravity = finite_or(options.gravity, 0.0F);
    glm::vec3& wind = options.wind.velocity;
    wind = {finite_or(wind.x, 0.0F), finite_or(wind.y, 0.0F), finite_or(wind.z, 0.0F)};
    options.wind.gust = not_negative(options.wind.gust);
    options.gust_period = not_negative(options.gust_period);
    options.damping = not_negative(options.damping);
    options.time_step = std::clamp(finite_or(options.time_step, 1.0F / 60.0F), 1e-6F, 10.0F);
    options.air_density = not_negative(options.air_density);
    options.surface_mass = not_negative(options.surface_mass);
    return options;
}

/// The rotation at rest of a body whose joint bears only this body, on a parent with the rotation
/// `start`. A force F at the end of the arm c bends the joint towards F by an angle x for which k x
/// = |c| |F| sin(a - x), where k is the spring constant and a the angle between c and F. There is
/// one root from 0 to a.
glm::dquat bent_by_itself(const Body& body, const glm::dquat& start, const Forces& forces) {
    constexpr int kHalvings = 60;
    constexpr int kWindRounds = 40; // the drag depends on the rotation
    const glm::dvec3 centre = start * body.centre;
    glm::dquat turn = start;
    for (int round = 0; round < (forces.windy ? kWindRounds : 1); ++round) {
        glm::dvec3 force = body.mass * forces.gravity;
        if (forces.windy) {
            force += wind_drag(body, turn, glm::dvec3(0.0), forces) * forces.wind;
        }
        const glm::dvec3 torque = glm::cross(centre, force);
        const double size = glm::length(torque);
        if (!(size > 0.0) || !std::isfinite(size)) {
            return start;
        }
        const double max_torque = glm::length(centre) * glm::length(force);
        const double whole = polar_angle(size, glm::dot(centre, force));
        double low = 0.0;
        double high = whole;
        for (int i = 0; i < kHalvings; ++i) {
            const double middle = 0.5 * (low + high);
            (body.spring * middle < max_torque * sine_cosine(whole - middle).sine ? low : high) =
                middle;
        }
        turn = glm::normalize(rotation_of(low / size * torque) * start);
    }
    return turn;
}

/// A period in s: `own`, or if `period` is positive, the whole fraction of `period` nearest to
/// `own`: `period` / n with n = round(period / own), at least 1.
double part_of(double period, double own) {
    return period > 0.0 ? period / std::max(std::round(period / own), 1.0) : own;
}
/// A smooth function of time from -1 to 1, 0 at time 0. It repeats after `period` if `period` is
/// positive.
double gust_at(double time, double period) {
    const double turns = 2.0 * std::numbers::pi * time;
    return 0.6 * sine_cosine(turns / part_of(period, 3.1)).sine +
           0.4 * sine_cosine(turns / part_of(period, 1.3)).sine;
}

Forces forces_of(const PhysicsOptions& options) {
    Forces forces;
    forces.step = static_cast<double>(options.time_step);
    forces.gravity = {0.0, -options.gravity, 0.0};
    forces.damping = static_cast<double>(options.damping);
    forces.wind = glm::dvec3(options.wind.velocity);
    forces.drag = 0.5 * kDragCoefficient * static_cast<double>(options.air_density);
    forces.windy = forces.drag > 0.0 && glm::length(forces.wind) > 0.0;
    forces.ground = options.ground;
    forces.friction = kFriction;
    forces.own_load = options.load == LoadRule::Own;
    return forces;
}

/// Raises an object and its far end out of the ground if both are above the ground at rest.
void lay_on_ground(const PlacedObject& rest, PlacedObject& object) {
    const float length = std::abs(object.size);
    if (rest.position.y < 0.0F) {
        return;
    }
    object.position.y = std::max(object.position.y, 0.0F);
    const glm::vec3 axis = heading(object.frame);
    const float sink = -(object.position.y + length * axis.y);
    if (!(sink > 0.0F) || rest.position.y + length * heading(rest.frame).y < 0.0F) {
        return;
    }
    Contact end;
    end.tip = static_cast<double>(length) * glm::dvec3(axis);
    end.clearance = -static_cast<double>(sink);
    object.frame = glm::quat(glm::normalize(
        raised(end, glm::dquat(1.0, 0.0, 0.0, 0.0), glm::dvec3(0.0)) * glm::dquat(object.frame)));
}

PlantBodies plant_of(Bodies bodies) {
    PlantBodies plant;
    plant.rest = std::move(bodies);
    const std::vector<std::uint32_t>& ends = plant.rest.level_ends;
    plant.schedule = Schedule(ends);
    std::uint32_t widest = 1; // max bodies of two consecutive depths
    for (std::size_t depth = 0; depth < ends.size(); ++depth) {
        widest = std::max(widest, ends[depth] - (depth < 2 ? 0 : ends[depth - 2]));
    }
    const std::size_t count = plant.rest.bodies.size();
    plant.reduced.resize(std::bit_ceil(widest));
    plant.reduced_mask = std::bit_ceil(widest) - 1;
    plant.poses.resize(count);
    plant.next_poses.resize(count);
    plant.motion.resize(count);
    plant.solution.resize(count);
    return plant;
}

} // namespace

struct PlantPhysics::State {
    State(const Skeleton& skeleton, const PhysicsOptions& given)
        : rest(skeleton), options(usable(given)), forces(forces_of(options)),
          workers(given.threads),
          plant(plant_of(make_bodies(skeleton, static_cast<double>(options.surface_mass)))) {}

    Skeleton rest;
    PhysicsOptions options;
    Forces forces;
    Workers workers;
    PlantBodies plant;
    double time = 0.0; // s
    double energy =
        0.0; // J, the allowed energy: the energy of the plant or, by rounding, a little less

    /// Computes poses, velocities and energy from the current motion.
    void update_energy() {
        for (std::size_t b = 0; b < plant.motion.size(); ++b) {
            plant.solution[b].spin = plant.motion[b].spin;
        }
        const Energies energies = move_bodies(plant, forces, 0.0, 1.0, workers);
        energy = energies.potential + energies.kinetic;
    }

    struct Step {
        double share = 0.0;       // fraction of the solved motion that was carried out
        double turn = 0.0;        // rad, max rotation of the complete solved motion
        double energy_loss = 0.0; // J, decrease of the energy plus the work done by the wind
        double slide = 0.0;       // J, Energies::slide
    };
    /// Moves the plant to rest under LoadRule::Own, where each joint bears only its own segment:
    /// joint by joint, from the root to the tips.
    void settle_own_loads() {
        const std::vector<Body>& bodies = plant.rest.bodies;
        plant.schedule.outward(workers, [&](std::uint32_t begin, std::uint32_t end, std::uint32_t) {
            for (std::uint32_t b = begin; b < end; ++b) {
                const Body& body = bodies[b];
                BodyPose at;
                if (body.parent != kNoSegment) {
                    const BodyPose& parent = plant.poses[body.parent];
                    at.turn = parent.turn;
                    at.shift = parent.shift + (parent.turn * body.offset - body.offset);
                }
                at.turn = bent_by_itself(body, at.turn, forces);
                if (forces.ground) {
                    at.turn = raised(body.contact, at.turn, at.shift);
                }
                plant.poses[b] = at;
            }
        });
        plant.motion.assign(plant.motion.size(), BodyMotion{});
        update_energy();
    }

    /// Makes a step. Without `keep_velocity` the plant stands still at its end.
    Step advance(const Forces& current_forces, bool keep_velocity) {
        solve_spins(plant, current_forces, workers);
        const int trials = current_forces.exactness > 0.0 ? kExactTrials : kTrials;
        double share = 1.0;
        double turn = 0.0;
        for (int trial = 0; trial <= trials; ++trial) {
            share = trial == trials ? 0.0 : share;
            const Energies energies =
                move_bodies(plant, current_forces, share * current_forces.step,
                            keep_velocity ? share : 0.0, workers);
            turn = trial == 0 ? energies.turn : turn;
            const double allowed =
                energy + std::max(current_forces.windy ? energies.work : 0.0, 0.0);
            const bool is_finite = std::isfinite(energies.potential + energies.kinetic);
            if (share > 0.0 &&
                !(is_finite &&
                  energies.potential <= allowed + kRounding * energies.potential_magnitude)) {
                share *= kTrialRatio;
                continue;
            }
            const double left = std::max(allowed - energies.potential, 0.0);
            double kinetic = energies.kinetic;
            if (share > 0.0 && kinetic > left) {
                scale_velocities(plant, std::sqrt(left / kinetic), workers);
                kinetic = left;
            }
            energy = std::min(allowed, energies.potential + kinetic);
            plant.poses.swap(plant.next_poses);
            return {share, turn, allowed - energy, energies.slide};
        }
        return {};
    }

    enum class End { Rest, Falling, OutOfRounds };
    struct Rounds {
        std::uint32_t left = 0;         // remaining rounds
        bool starts_from_stage = false; // the first pose is the result of a coarser stage
        bool is_last = false;           // no stage follows
        bool stop_falling = false;      // ends with End::Falling if the plant falls
    };
    /// Makes rounds of settle() and subtracts their number from `rounds.left`.
    End make_rounds(Forces current_forces, double tolerance, Rounds& rounds) {
        BoundWeight bound_weight;
        current_forces.exactness = 0.0;
        RecentRounds recent(rounds.starts_from_stage && plant.poses.size() >= kManyBodies,
                            rounds.is_last);
        for (std::uint32_t round = 0; rounds.left > 0; ++round) {
            const Step last_step = advance(current_forces, false);
            --rounds.left;
            // Excludes the first round of a stage, in which twigs fall that coarser stages left
            // out.
            if (!(rounds.starts_from_stage && round == 0)) {
                recent.add(last_step.share, last_step.energy_loss, last_step.slide);
            }
            if (last_step.turn <= tolerance || (last_step.share == 1.0 && recent.is_held())) {
                return End::Rest;
            }
            if (rounds.stop_falling && (last_step.turn > kFallingTurn || round >= kFallingRounds)) {
                return End::Falling;
            }
            bound_weight.update(last_step.share == 1.0);
            current_forces.exactness = 1.0 - bound_weight.value();
        }
        return End::OutOfRounds;
    }

    /// Poses of all bodies after the plant has settled in stages; the state does not change.
    [[nodiscard]] std::vector<BodyPose> settled_in_stages(const std::vector<CoarsePlant>& stages,
                                                          const Forces& current_forces,
                                                          double tolerance) {
        PlantBodies whole;
        std::swap(plant, whole);
        const double energy_before = energy;
        std::vector<BodyPose> poses = whole.poses;
        std::vector<char> known(poses.size(), 0);
        for (const CoarsePlant& stage : stages) {
            complete_poses(whole.rest, known, whole.poses, forces.ground, poses);
            plant = plant_of(stage.bodies);
            plant.poses = coarse_poses(stage, poses);
            update_energy();
            const std::size_t max_rounds = kStageWork * whole.poses.size() / plant.poses.size();
            Rounds rounds{.left = static_cast<std::uint32_t>(std::min(max_rounds, kMaxStageRounds)),
                          .starts_from_stage = &stage != &stages.front()};
            make_rounds(current_forces, tolerance, rounds);
            spread_poses(stage, plant.poses, poses);
            for (const std::uint32_t b : stage.run_bodies) {
                known[b] = 1;
            }
        }
        complete_poses(whole.rest, known, whole.poses, forces.ground, poses);
        std::swap(plant, whole);
        energy = energy_before;
        return poses;
    }

    /// Implements settle() for LoadRule::Carried, from standstill.
    bool come_to_rest(const Forces& current_forces, double tolerance, std::uint32_t max_rounds) {
        const bool may_fall = plant.poses.size() >= kMinCoarsened;
        Rounds rounds{.left = max_rounds, .stop_falling = may_fall};
        End end = make_rounds(current_forces, tolerance, rounds);
        rounds.stop_falling = false;
        if (end != End::Falling) {
            return end == End::Rest;
        }
        const std::vector<CoarsePlant> stages = coarse_plants(plant.rest);
        if (!stages.empty()) {
            const std::vector<BodyPose> before = plant.poses;
            const double energy_before = energy;
            plant.poses = settled_in_stages(stages, current_forces, tolerance);
            update_energy();
            rounds.starts_from_stage = true;
            rounds.is_last = true;
            end = make_rounds(current_forces, tolerance, rounds);
            if (current_forces.windy || energy <= energy_before) {
                return end == End::Rest;
            }
            plant.poses = before;
            update_energy();
            energy = energy_before;
            rounds.starts_from_stage = false;
        }
        return make_rounds(current_forces, tolerance, rounds) == End::Rest;
    }
};

PlantPhysics::PlantPhysics(const Skeleton& rest, const PhysicsOptions& options)
    : state_(std::make_unique<State>(rest, options)) {}

PlantPhysics::~PlantPhysics() = default;

void PlantPhysics::set(const PhysicsOptions& options) {
    State& s = *state_;
    const PhysicsOptions before = s.options;
    s.options = usable(options);
    s.options.threads = before.threads;
    s.forces = forces_of(s.options);
    if (s.options.surface_mass != before.surface_mass) {
        s.plant.rest = make_bodies(s.rest, static_cast<double>(s.options.surface_mass));
    }
    s.update_energy();
}

const PhysicsOptions& PlantPhysics::options() const {
    return state_->options;
}

void PlantPhysics::step() {
    State& s = *state_;
    Forces current_forces = s.forces;
    const auto gust = static_cast<double>(s.options.wind.gust);
    current_forces.wind *=
        std::max(1.0 + gust * gust_at(s.time, static_cast<double>(s.options.gust_period)), 0.0);
    s.advance(current_forces, true);
    s.time += current_forces.step;
}

bool PlantPhysics::settle(double tolerance, std::uint32_t max_rounds) {
    State& s = *state_;
    if (s.forces.own_load) {
        s.settle_own_loads();
        return true;
    }
    Forces rest_forces = s.forces;
    rest_forces.step = kSettleStep;
    rest_forces.damping = 0.0;
    rest_forces.friction = 0.0;
    scale_velocities(s.plant, 0.0, s.workers);
    s.update_energy();
    return s.come_to_rest(rest_forces, tolerance, max_rounds);
}

std::uint32_t settle_rounds(std::size_t segments) {
    constexpr std::size_t kWork = 3'000'000; // max number of moved segments, summed over rounds
    const std::size_t rounds = kWork / std::max(segments, std::size_t{1});
    return static_cast<std::uint32_t>(std::clamp(rounds, std::size_t{30}, std::size_t{10'000}));
}

void PlantPhysics::reset() {
    State& s = *state_;
    s.plant.poses.assign(s.plant.poses.size(), BodyPose{});
    s.plant.motion.assign(s.plant.motion.size(), BodyMotion{});
    s.time = 0.0;
    s.energy = 0.0;
}

double PlantPhysics::time() const {
    return state_->time;
}

double PlantPhysics::energy() const {
    return state_->energy;
}

const Skeleton& PlantPhysics::rest() const {
    return state_->rest;
}

void PlantPhysics::pose(Skeleton& out) const {
    const State& s = *state_;
    out = s.rest;
    std::vector<BodyPose> poses = s.plant.poses;
    if (s.options.ground) {
        rest_on_ground(s.plant.rest, s.rest, poses);
    }
    const auto moved = [&](std::uint32_t segment, const glm::vec3& point) {
        const BodyPose& pose = poses[s.plant.rest.body_of_segment[segment]];
        const glm::dvec3 arm = glm::dvec3(point) - glm::dvec3(s.rest.segments[segment].base);
        return glm::vec3(glm::dvec3(point) + pose.shift + (pose.turn * arm - arm));
    };
    const auto turned_frame = [&](std::uint32_t segment, const glm::quat& frame) {
        const glm::dquat& turn = poses[s.plant.rest.body_of_segment[segment]].turn;
        return turn == glm::dquat(1.0, 0.0, 0.0, 0.0)
                   ? frame
                   : glm::quat(glm::normalize(turn * glm::dquat(frame)));
    };
    for (std::uint32_t i = 0; i < out.segments.size(); ++i) {
        Segment& segment = out.segments[i];
        segment.base = moved(i, segment.base);
        segment.frame = turned_frame(i, segment.frame);
    }
    for (PlacedObject& object : out.objects) {
        if (object.parent < out.segments.size()) {
            const PlacedObject before = object;
            object.position = moved(object.parent, object.position);
            object.frame = turned_frame(object.parent, object.frame);
            if (s.options.ground) {
                lay_on_ground(before, object);
            }
        }
    }
    for (Polygon& polygon : out.polygons) {
        if (polygon.parent < out.segments.size()) {
            for (std::uint32_t c = 0; c < polygon.corner_count; ++c) {
                glm::vec3& corner = out.corners[polygon.first_corner + c];
                const float before = corner.y;
                corner = moved(polygon.parent, corner);
                corner.y = s.options.ground && before >= 0.0F ? std::max(corner.y, 0.0F) : corner.y;
            }
            polygon.frame = turned_frame(polygon.parent, polygon.frame);
        }
    }
}

} // namespace lsys
