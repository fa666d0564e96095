// SPDX-License-Identifier: MIT
#include "runtime/export/impl/usda_skin.h"

#include "runtime/export/impl/usda_parts.h"

#include <fmt/format.h>
#include <glm/mat4x4.hpp>

#include <string>
#include <tuple>
#include <vector>

namespace lsys {

namespace {

constexpr std::string_view kStillJoint = "plant"; // name of joint 0, which never moves

/// Writes `head [...]` in one line, which readers need for samples of an animation; put(i) writes
/// item i.
template <typename Put>
void put_items(PieceWriter& out, std::string_view head, std::size_t count, const Put& put) {
    out.put(head);
    out.put("[");
    for (std::size_t i = 0; i < count && !out.stopped(); ++i) {
        out.put(i == 0 ? "" : ", ");
        put(i);
    }
    out.put("]");
}

/// Paths of the joints. Joint 0 is the parent of all other joints, or with UsdaMotion::bones their
/// ancestor.
std::vector<std::string> joint_paths(const UsdaMotion& motion) {
    std::vector<std::string> paths{std::string(kStillJoint)};
    for (std::size_t joint = 1; joint < motion.joint_count(); ++joint) {
        const Bone* const bone = motion.bones ? &motion.bones->joints[joint] : nullptr;
        paths.push_back(
            fmt::format("{}/segment_{}", paths[bone != nullptr ? bone->parent : 0],
                        bone != nullptr ? bone->segment : motion.skin.segments[joint - 1]));
    }
    return paths;
}

void put_joint_names(const UsdaMotion& motion, std::string_view head, PieceWriter& out) {
    const std::vector<std::string> paths = joint_paths(motion);
    put_items(out, head, paths.size(),
              [&](std::size_t joint) { out.put(fmt::format("\"{}\"", paths[joint])); });
    out.put("\n");
}

/// A joint in the first frame.
struct JointPlace {
    glm::dvec3 base{0.0};
    glm::dquat frame{1.0, 0.0, 0.0, 0.0};
};

JointPlace place_in_world(const UsdaMotion& motion, std::size_t joint) {
    if (joint == 0) {
        return {};
    }
    if (motion.bones) {
        const Bone& bone = motion.bones->joints[joint];
        return {bone.place, bone.frame};
    }
    const SegmentPlace& place = motion.poses.frame(0)[motion.skin.segments[joint - 1]];
    return {glm::dvec3(place.base), glm::dquat(place.frame)};
}

JointPlace place_at_parent(const UsdaMotion& motion, std::size_t joint) {
    if (!motion.bones || joint == 0) { // the parent is at the origin
        return place_in_world(motion, joint);
    }
    const Bone& bone = motion.bones->joints[joint];
    return {glm::dvec3(bone.translation), glm::dquat(bone.rotations.front())};
}

/// Writes matrices for row vectors: three rows with the axes of the joint, then its place.
template <typename PlaceOf>
void put_places(const UsdaMotion& motion,
                std::string_view head,
                PieceWriter& out,
                const PlaceOf& place_of) {
    put_items(out, head, motion.joint_count(), [&](std::size_t joint) {
        const JointPlace place = place_of(motion, joint);
        glm::dmat4 matrix = glm::mat4_cast(glm::normalize(place.frame));
        matrix[3] = glm::dvec4(place.base, 1.0);
        for (int row = 0; row < 4; ++row) {
            const glm::vec4 r(matrix[row]);
            out.put(fmt::format("{}({}, {}, {}, {})", row == 0 ? "(" : ", ", r.x, r.y, r.z, r.w));
        }
        out.put(")");
    });
    out.put("\n");
}

/// Writes `name.timeSamples`. put(frame, joint) writes the item of a joint other than joint 0;
/// `still` is the item of joint 0.
template <typename Put>
void put_samples(const UsdaMotion& motion,
                 std::string_view name,
                 std::string_view still,
                 PieceWriter& out,
                 const Put& put) {
    out.put(fmt::format("            {}.timeSamples = {{\n", name));
    for (std::uint32_t frame = 0; frame < motion.poses.frame_count && !out.stopped(); ++frame) {
        put_items(out, fmt::format("                {}: ", frame), motion.joint_count(),
                  [&](std::size_t joint) {
                      if (joint == 0) {
                          out.put(still);
                      } else {
                          put(frame, joint);
                      }
                  });
        out.put(",\n");
    }
    out.put("            }\n");
}

void put_rotation(const glm::quat& q, PieceWriter& out) {
    out.advance_to(put_tuple<4>(out.room(kUsdaItemBytes + kNumberBytes), {q.w, q.x, q.y, q.z}));
}

/// Samples of joints that turn and move, relative to the world.
void put_segment_samples(const UsdaMotion& motion, PieceWriter& out) {
    put_samples(
        motion, "float3[] translations", "(0, 0, 0)", out,
        [&](std::uint32_t frame, std::size_t joint) {
            const glm::vec3& base = motion.poses.frame(frame)[motion.skin.segments[joint - 1]].base;
            out.advance_to(put_tuple<3>(out.room(kUsdaItemBytes), {base.x, base.y, base.z}));
        });
    // As in joint_rotations(), consecutive rotations have a positive dot product.
    std::vector<glm::quat> last(motion.joint_count(), glm::quat(0.0F, 0.0F, 0.0F, 0.0F));
    put_samples(motion, "quatf[] rotations", "(1, 0, 0, 0)", out,
                [&](std::uint32_t frame, std::size_t joint) {
                    const SegmentPlace& place =
                        motion.poses.frame(frame)[motion.skin.segments[joint - 1]];
                    const glm::quat turn(glm::normalize(glm::dquat(place.frame)));
                    const glm::quat q = glm::dot(last[joint], turn) < 0.0F ? -turn : turn;
                    last[joint] = q;
                    put_rotation(q, out);
                });
}

/// Samples of Bones, which turn and do not move.
void put_bone_samples(const UsdaMotion& motion, PieceWriter& out) {
    const std::vector<Bone>& joints = motion.bones->joints;
    put_items(out, "            float3[] translations = ", joints.size(), [&](std::size_t joint) {
        const glm::vec3& at = joints[joint].translation;
        out.advance_to(put_tuple<3>(out.room(kUsdaItemBytes), {at.x, at.y, at.z}));
    });
    out.put("\n");
    put_samples(motion, "quatf[] rotations", "(1, 0, 0, 0)", out,
                [&](std::uint32_t frame, std::size_t joint) {
                    put_rotation(joints[joint].rotations[frame], out);
                });
}

} // namespace

void put_usda_times(const PlantAnimation& poses, PieceWriter& out) {
    out.put(fmt::format("    startTimeCode = 0\n"
                        "    endTimeCode = {}\n"
                        "    timeCodesPerSecond = {}\n"
                        "    framesPerSecond = {}\n",
                        poses.frame_count - 1, poses.frames_per_second, poses.frames_per_second));
}

void put_usda_joints(const Mesh& mesh,
                     const UsdaMotion& motion,
                     std::string_view root,
                     PieceWriter& out) {
    constexpr std::string_view kInterpolation = "            interpolation = \"vertex\"\n"
                                                "        )\n";
    const std::size_t each = motion.bones ? std::tuple_size_v<decltype(BoneWeights::joints)> : 2;
    const std::string size = fmt::format(" (\n            elementSize = {}\n", each);
    const std::uint64_t count = each * std::uint64_t{mesh.segments.size()};
    const auto joint_of = [&](std::uint64_t i) {
        return motion.skin.joint_of(mesh.segments[i / 2][i % 2]);
    };
    BoneWeights weights; // of vertex i / each
    const auto weights_at = [&](std::uint64_t i) -> const BoneWeights& {
        if (i % each == 0) {
            weights = motion.bones->weights_of(mesh.segments[i / each], mesh.positions[i / each]);
        }
        return weights;
    };
    put_list(out, "int[] primvars:skel:jointIndices", count, [&](std::uint64_t i, char* at) {
        return put_number(
            at, std::uint64_t{motion.bones ? weights_at(i).joints[i % each] : joint_of(i)});
    });
    out.put(size);
    out.put(kInterpolation);
    put_list(out, "float[] primvars:skel:jointWeights", count, [&](std::uint64_t i, char* at) {
        if (motion.bones) {
            return put_number(at, weights_at(i).weights[i % each]);
        }
        const bool shared = joint_of(i / 2 * 2) != joint_of(i / 2 * 2 + 1);
        return put_text(at, shared ? "0.5" : i % 2 == 0 ? "1" : "0");
    });
    out.put(size);
    out.put(kInterpolation);
    out.put(fmt::format("        matrix4d primvars:skel:geomBindTransform = "
                        "((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))\n"
                        "        rel skel:skeleton = <{}/Skeleton>\n",
                        root));
}

void put_usda_skeleton(const UsdaMotion& motion, std::string_view root, PieceWriter& out) {
    out.put("\n    def Skeleton \"Skeleton\" (\n"
            "        prepend apiSchemas = [\"SkelBindingAPI\"]\n"
            "    )\n"
            "    {\n");
    put_joint_names(motion, "        uniform token[] joints = ", out);
    put_places(motion, "        uniform matrix4d[] bindTransforms = ", out, place_in_world);
    put_places(motion, "        uniform matrix4d[] restTransforms = ", out, place_at_parent);
    out.put(fmt::format("        rel skel:animationSource = <{}/Skeleton/Motion>\n\n"
                        "        def SkelAnimation \"Motion\"\n"
                        "        {{\n",
                        root));
    put_joint_names(motion, "            uniform token[] joints = ", out);
    if (motion.bones) {
        put_bone_samples(motion, out);
    } else {
        put_segment_samples(motion, out);
    }
    put_items(out, "            half3[] scales = ", motion.joint_count(),
              [&](std::size_t) { out.put("(1, 1, 1)"); });
    out.put("\n        }\n    }\n");
}

} // namespace lsys
