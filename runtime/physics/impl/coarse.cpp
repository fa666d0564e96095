// SPDX-License-Identifier: MIT
// A limp twig loads its branch like a mass at the base of the twig, and a run has the weight of its
// bodies. A coarse plant also keeps Body::moment and the contacts with the ground, so it falls like
// the whole plant.
#include "runtime/physics/impl/coarse.h"

#include "runtime/physics/impl/ground.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <numbers>
#include <span>

namespace lsys {

namespace {

constexpr std::uint32_t kCoarsestBodyCount = 500; // bodies of the coarsest plant, approximately
constexpr std::uint32_t kBodyRatio = 4;           // approximate ratio to the next coarser plant
constexpr double kMinBodyRatio = 3.0;             // min of this ratio
// Max of Coarsening::relative_twig_size(). A plant with larger twigs is nearly a chain: most of its
// weight would be at the ends of the bodies that are kept. Such a plant is cut into runs instead.
constexpr double kMaxRelativeTwig = 32.0;

/// Area in m^2 of the segment that faces the wind, mean over all directions.
float mean_area(const Body& body) {
    constexpr float kMeanSine = std::numbers::pi_v<float> / 4.0F;
    constexpr float kMeanCosine = 0.5F;
    return kMeanSine * body.side + kMeanCosine * body.end;
}

/// Sums over each body and all its descendants; arrays are indexed by body.
struct Twigs {
    std::vector<std::uint32_t> sizes; // numbers of bodies
    std::vector<double> masses;       // kg
    std::vector<float> wind_areas;    // m^2, area in the wind, mean over all directions
};

Twigs twigs_of(const std::vector<Body>& bodies) {
    const std::size_t count = bodies.size();
    Twigs out{std::vector<std::uint32_t>(count, 1), std::vector<double>(count, 0.0),
              std::vector<float>(count, 0.0F)};
    for (std::size_t b = count; b-- > 0;) {
        const Body& body = bodies[b];
        out.masses[b] += body.mass;
        out.wind_areas[b] += mean_area(body) + body.sail;
        if (body.parent != kNoSegment) {
            out.sizes[body.parent] += out.sizes[b];
            out.masses[body.parent] += out.masses[b];
            out.wind_areas[body.parent] += out.wind_areas[b];
        }
    }
    return out;
}

/// Position of body number `i` in a run of `length` bodies: 0 at the base of the run, 1 at its tip.
double place_in_run(std::size_t i, std::size_t length) {
    return (static_cast<double>(i) + 0.5) / static_cast<double>(length);
}
/// Weight of the rotation of the body's own run, for a body at `place` in this run. The remaining
/// weight belongs to the rotation of the parent run. `joined`: the run is the only child of its
/// parent run, whose last bodies already turn towards it (turned_ahead()).
double turned_part(double place, bool joined) {
    return std::min(joined ? 0.5 + place : 2.0 * place, 1.0);
}
/// Weight of the rotation of the next run, for a body at `place` in the run before it.
double turned_ahead(double place) {
    return std::max(place - 0.5, 0.0);
}

std::span<const std::uint32_t> run_of(const CoarsePlant& plant, std::uint32_t run) {
    const std::uint32_t begin = run == 0 ? 0 : plant.run_ends[run - 1];
    return std::span(plant.run_bodies).subspan(begin, plant.run_ends[run] - begin);
}
/// Whether a run is the only child of its parent run.
bool is_joined(const CoarsePlant& plant, std::uint32_t run) {
    const std::uint32_t parent = plant.bodies.bodies[run].parent;
    return parent != kNoSegment && plant.bodies.bodies[parent].child_count == 1;
}

/// Keeps only the contacts that are farthest in some direction, if there are many.
void keep_outermost(std::vector<Contact>& contacts) {
    constexpr std::array<glm::dvec3, 7> kDirections = {
        glm::dvec3(1.0, 0.0, 0.0),  glm::dvec3(0.0, 1.0, 0.0),  glm::dvec3(0.0, 0.0, 1.0),
        glm::dvec3(1.0, 1.0, 1.0),  glm::dvec3(1.0, 1.0, -1.0), glm::dvec3(1.0, -1.0, 1.0),
        glm::dvec3(1.0, -1.0, -1.0)};
    if (contacts.size() <= 2 * kDirections.size()) {
        return;
    }
    std::vector<std::size_t> outer;
    for (const glm::dvec3& direction : kDirections) {
        const auto [low, high] = std::minmax_element(
            contacts.begin(), contacts.end(), [&](const Contact& a, const Contact& b) {
                return glm::dot(direction, a.tip) < glm::dot(direction, b.tip);
            });
        outer.push_back(static_cast<std::size_t>(low - contacts.begin()));
        outer.push_back(static_cast<std::size_t>(high - contacts.begin()));
    }
    std::sort(outer.begin(), outer.end());
    outer.erase(std::unique(outer.begin(), outer.end()), outer.end());
    for (std::size_t i = 0; i < outer.size(); ++i) {
        contacts[i] = contacts[outer[i]];
    }
    contacts.resize(outer.size());
}

/// Makes the coarse plant that keeps the bodies with at least `min_size` bodies in their subtree.
/// Runs have at most `longest` bodies.
class Coarsening {
public:
    Coarsening(const Bodies& plant,
               const Twigs& twigs,
               std::uint32_t min_size,
               std::uint32_t longest)
        : plant_(&plant), twigs_(&twigs), min_size_(min_size), longest_(longest) {}

    /// Mean, over the bodies that are left out, of the number of bodies of their twig, divided by
    /// the number of bodies of the plant per kept body.
    [[nodiscard]] double relative_twig_size() const {
        double kept = 0.0;
        double squares = 0.0;
        for (std::uint32_t b = 0; b < plant_->bodies.size(); ++b) {
            const std::uint32_t parent = plant_->bodies[b].parent;
            if (is_kept(b)) {
                kept += 1.0;
            } else if (parent == kNoSegment || is_kept(parent)) {
                const auto size = static_cast<double>(twigs_->sizes[b]);
                squares += size * size;
            }
        }
        const auto all = static_cast<double>(plant_->bodies.size());
        return kept < all ? squares / (all - kept) * kept / all : 0.0;
    }

    [[nodiscard]] std::uint32_t count_runs() const {
        std::uint32_t count = 0;
        // By body: number of bodies in its run, from the base of the run to the body itself.
        std::vector<std::uint32_t> lengths(plant_->bodies.size(), 0);
        for (std::uint32_t b = 0; b < plant_->bodies.size(); ++b) {
            if (is_kept(b)) {
                lengths[b] = lengths[b] % longest_ + 1;
                count += lengths[b] == 1 ? 1U : 0U;
                if (const std::uint32_t next = only_kept_child(b); next != kNoSegment) {
                    lengths[next] = lengths[b];
                }
            }
        }
        return count;
    }

    [[nodiscard]] CoarsePlant make() const {
        CoarsePlant out;
        std::vector<std::uint32_t> first_bodies; // first body of each run
        for (std::uint32_t b = 0;
             b < plant_->bodies.size() && plant_->bodies[b].parent == kNoSegment; ++b) {
            if (is_kept(b)) {
                first_bodies.push_back(b);
                out.bodies.bodies.push_back({});
            }
        }
        std::uint32_t begin = 0;
        while (begin < first_bodies.size()) {
            const auto end = static_cast<std::uint32_t>(first_bodies.size());
            out.bodies.level_ends.push_back(end);
            for (std::uint32_t run = begin; run < end; ++run) {
                add_run(run, first_bodies, out);
            }
            begin = end;
        }
        set_springs(out);
        return out;
    }

private:
    [[nodiscard]] bool is_kept(std::uint32_t body) const {
        return twigs_->sizes[body] >= min_size_;
    }

    /// The only kept child of `b`; kNoSegment if none or several children are kept.
    [[nodiscard]] std::uint32_t only_kept_child(std::uint32_t b) const {
        const Body& body = plant_->bodies[b];
        std::uint32_t only = kNoSegment;
        for (std::uint32_t c = body.first_child; c < body.first_child + body.child_count; ++c) {
            if (is_kept(c)) {
                if (only != kNoSegment) {
                    return kNoSegment;
                }
                only = c;
            }
        }
        return only;
    }

    /// Adds to `body` the masses of `member`, whose base is at `base`, and of its twigs that are
    /// left out.
    void add_masses(const Body& member,
                    const glm::dvec3& base,
                    Body& body,
                    glm::dvec3& first_moment) const {
        body.mass += member.mass;
        first_moment += member.mass * (base + member.centre);
        body.inertia += member.inertia;
        body.inertia += point_inertia(-member.mass, member.centre);
        body.inertia += point_inertia(member.mass, base + member.centre);
        for (std::uint32_t c = member.first_child; c < member.first_child + member.child_count;
             ++c) {
            if (!is_kept(c)) {
                const glm::dvec3 place = base + plant_->bodies[c].offset;
                body.mass += twigs_->masses[c];
                first_moment += twigs_->masses[c] * place;
                body.inertia += point_inertia(twigs_->masses[c], place);
                body.sail = std::min(body.sail + twigs_->wind_areas[c], 1e30F);
            }
        }
    }

    /// Makes the body of the run `run`, and adds the runs that begin at its end to `out`.
    void
    add_run(std::uint32_t run, std::vector<std::uint32_t>& first_bodies, CoarsePlant& out) const {
        Body body = out.bodies.bodies[run]; // parent and offset are already set
        std::vector<Contact> contacts;
        glm::dvec3 first_moment(0.0);
        glm::dvec3 base(0.0); // base of `last`
        float areas = 0.0F;   // m^2, area of segments in the wind
        std::uint32_t last = first_bodies[run];
        std::uint32_t length = 1;
        for (;; ++length) {
            const Body& member = plant_->bodies[last];
            out.run_bodies.push_back(last);
            add_masses(member, base, body, first_moment);
            body.sail = std::min(body.sail + member.sail, 1e30F);
            areas += mean_area(member);
            if (member.contact.spring > 0.0) {
                contacts.push_back(member.contact);
                contacts.back().tip += base;
            }
            const std::uint32_t next = only_kept_child(last);
            if (next == kNoSegment || length == longest_) {
                break;
            }
            last = next;
            base += plant_->bodies[last].offset;
        }
        out.run_ends.push_back(static_cast<std::uint32_t>(out.run_bodies.size()));
        if (body.mass > 0.0) {
            body.centre = first_moment / body.mass;
        }
        const Body& end = plant_->bodies[last];
        if (length == 1) {
            body.heading = end.heading;
            body.side = end.side;
            body.end = end.end;
            body.contact = end.contact;
        } else {
            body.sail = std::min(body.sail + areas, 1e30F);
            keep_outermost(contacts);
            body.first_contact = static_cast<std::uint32_t>(out.bodies.contacts.size());
            body.contact_count = static_cast<std::uint32_t>(contacts.size());
            out.bodies.contacts.insert(out.bodies.contacts.end(), contacts.begin(), contacts.end());
        }
        body.moment = first_moment;
        body.first_child = static_cast<std::uint32_t>(first_bodies.size());
        for (std::uint32_t c = end.first_child; c < end.first_child + end.child_count; ++c) {
            if (is_kept(c)) {
                Body child;
                child.parent = run;
                child.offset = base + plant_->bodies[c].offset;
                body.moment += twigs_->masses[c] * child.offset;
                first_bodies.push_back(c);
                out.bodies.bodies.push_back(child);
            }
        }
        body.child_count = static_cast<std::uint32_t>(first_bodies.size()) - body.first_child;
        out.bodies.bodies[run] = body;
    }

    /// Sets the spring of each run so that its energy equals the energy of the springs within the
    /// run when spread_poses() bends these.
    void set_springs(CoarsePlant& out) const {
        for (std::uint32_t run = 0; run < out.bodies.bodies.size(); ++run) {
            Body& body = out.bodies.bodies[run];
            const bool joined = is_joined(out, run);
            double before = 0.0;
            if (joined) {
                double ahead = 0.0;
                const std::span<const std::uint32_t> members = run_of(out, body.parent);
                for (std::size_t i = 0; i < members.size(); ++i) {
                    before = turned_ahead(place_in_run(i, members.size()));
                    body.spring +=
                        plant_->bodies[members[i]].spring * (before - ahead) * (before - ahead);
                    ahead = before;
                }
            }
            const std::span<const std::uint32_t> members = run_of(out, run);
            for (std::size_t i = 0; i < members.size(); ++i) {
                const double part = turned_part(place_in_run(i, members.size()), joined);
                body.spring +=
                    plant_->bodies[members[i]].spring * (part - before) * (part - before);
                before = part;
            }
        }
    }

private:
    const Bodies* plant_;
    const Twigs* twigs_;
    std::uint32_t min_size_; // min bodies in the subtree of a body that is kept
    std::uint32_t longest_;  // max bodies of a run
};

glm::dquat mixed(const glm::dquat& from, glm::dquat to, double share) {
    to = glm::dot(from, to) < 0.0 ? -to : to;
    return share >= 1.0 ? to : glm::normalize((1.0 - share) * from + share * to);
}

} // namespace

std::vector<CoarsePlant> coarse_plants(const Bodies& plant) {
    std::vector<CoarsePlant> out;
    const std::size_t count = plant.bodies.size();
    if (count < kMinCoarsened) {
        return out;
    }
    const Twigs twigs = twigs_of(plant.bodies);
    std::vector<std::uint32_t> sorted = twigs.sizes;
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    for (std::size_t max_count = kCoarsestBodyCount; max_count < count; max_count *= kBodyRatio) {
        // Keeps the bodies with the most descendants, at most `max_count` of them.
        Coarsening coarsening(plant, twigs, sorted[max_count] + 1, 1);
        if (coarsening.relative_twig_size() > kMaxRelativeTwig) {
            std::uint32_t longest = 1;
            do {
                longest *= 2;
                coarsening = Coarsening(plant, twigs, longest, longest);
            } while (coarsening.count_runs() > max_count);
        }
        const auto run_count = static_cast<double>(coarsening.count_runs());
        const bool is_coarse_enough = kMinBodyRatio * run_count <= static_cast<double>(count);
        const double coarser_count =
            out.empty() ? 0.0 : static_cast<double>(out.back().bodies.bodies.size());
        if (run_count > 0.0 && is_coarse_enough && run_count >= kMinBodyRatio * coarser_count) {
            out.push_back(coarsening.make());
        }
    }
    return out;
}

std::vector<BodyPose> coarse_poses(const CoarsePlant& coarse, const std::vector<BodyPose>& poses) {
    std::vector<BodyPose> out(coarse.run_ends.size());
    for (std::uint32_t run = 0; run < out.size(); ++run) {
        const std::span<const std::uint32_t> members = run_of(coarse, run);
        const glm::dquat middle = poses[members[members.size() / 2]].turn;
        if (members.size() == 1) {
            out[run].turn = middle;
            continue;
        }
        glm::dquat sum(0.0, 0.0, 0.0, 0.0);
        for (const std::uint32_t b : members) {
            sum += glm::dot(middle, poses[b].turn) < 0.0 ? -poses[b].turn : poses[b].turn;
        }
        out[run].turn = glm::normalize(sum);
    }
    return out;
}

void spread_poses(const CoarsePlant& coarse,
                  const std::vector<BodyPose>& runs,
                  std::vector<BodyPose>& poses) {
    for (std::uint32_t run = 0; run < runs.size(); ++run) {
        const Body& body = coarse.bodies.bodies[run];
        const bool joined = is_joined(coarse, run);
        const glm::dquat before =
            body.parent == kNoSegment ? glm::dquat(1.0, 0.0, 0.0, 0.0) : runs[body.parent].turn;
        const glm::dquat& own = runs[run].turn;
        const std::span<const std::uint32_t> members = run_of(coarse, run);
        for (std::size_t i = 0; i < members.size(); ++i) {
            const double place = place_in_run(i, members.size());
            const double ahead = body.child_count == 1 ? turned_ahead(place) : 0.0;
            poses[members[i]].turn = ahead > 0.0 ? mixed(own, runs[body.first_child].turn, ahead)
                                                 : mixed(before, own, turned_part(place, joined));
        }
    }
}

void complete_poses(const Bodies& plant,
                    const std::vector<char>& known,
                    const std::vector<BodyPose>& before,
                    bool ground,
                    std::vector<BodyPose>& poses) {
    for (std::size_t b = 0; b < plant.bodies.size(); ++b) {
        const Body& body = plant.bodies[b];
        BodyPose& pose = poses[b];
        if (body.parent == kNoSegment) {
            pose.shift = glm::dvec3(0.0);
            pose.turn = known[b] != 0 ? pose.turn : before[b].turn;
            continue;
        }
        const BodyPose& parent = poses[body.parent];
        pose.shift = parent.shift + (parent.turn * body.offset - body.offset);
        if (known[b] == 0) {
            pose.turn = glm::normalize(parent.turn *
                                       (glm::conjugate(before[body.parent].turn) * before[b].turn));
            pose.turn = ground ? raised(body.contact, pose.turn, pose.shift) : pose.turn;
        }
    }
}

} // namespace lsys
