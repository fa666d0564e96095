#include "runtime/export/impl/usda_skin.h"

#include "runtime/export/impl/usda_parts.h"

#include <fmt/format.h>
#include <glm/mat4x4.hpp>

#include <string>
#include <vector>

namespace lsys {

namespace {

constexpr std::string_view kStillJoint = "plant";

/// Writes `head [...]`; put(i) writes item i.
template <typename Put>
void put_items(PieceWriter& out, std::string_view head, std::size_t count, const Put& put) {
    out.put(head);
    out.put("[");
    for (std::size_t i = 0; i < count && !out.stopped(); ++i) {
        out.put(i == 0 ? "" : i % kUsdaItemsPerLine == 0 ? ",\n                " : ", ");
        put(i);
    }
    out.put("]");
}

/// Joint 0 is the parent of all others.
void put_joint_names(const Skin& skin, std::string_view head, PieceWriter& out) {
    put_items(out, head, skin.joint_count(), [&](std::size_t joint) {
        out.put(joint == 0
                    ? fmt::format("\"{}\"", kStillJoint)
                    : fmt::format("\"{}/segment_{}\"", kStillJoint, skin.segments[joint - 1]));
    });
    out.put("\n");
}

/// Row vectors: the axes of the joint, then its place.
void put_places(const UsdaMotion& motion, std::string_view head, PieceWriter& out) {
    put_items(out, head, motion.skin.joint_count(), [&](std::size_t joint) {
        glm::dmat4 matrix(1.0);
        if (joint > 0) {
            const SegmentPlace& place = motion.poses.frame(0)[motion.skin.segments[joint - 1]];
            matrix = glm::mat4_cast(glm::normalize(glm::dquat(place.frame)));
            matrix[3] = glm::dvec4(glm::dvec3(place.base), 1.0);
        }
        for (int row = 0; row < 4; ++row) {
            const glm::vec4 r(matrix[row]);
            out.put(fmt::format("{}({}, {}, {}, {})", row == 0 ? "(" : ", ", r.x, r.y, r.z, r.w));
        }
        out.put(")");
    });
    out.put("\n");
}

/// Writes `name.timeSamples`; put(frame, segment) writes the item of a joint but joint 0.
template <typename Put>
void put_samples(const UsdaMotion& motion,
                 std::string_view name,
                 std::string_view still,
                 PieceWriter& out,
                 const Put& put) {
    out.put(fmt::format("            {}.timeSamples = {{\n", name));
    for (std::uint32_t frame = 0; frame < motion.poses.frame_count && !out.stopped(); ++frame) {
        put_items(out, fmt::format("                {}: ", frame), motion.skin.joint_count(),
                  [&](std::size_t joint) {
                      if (joint == 0) {
                          out.put(still);
                      } else {
                          put(frame, joint - 1);
                      }
                  });
        out.put(",\n");
    }
    out.put("            }\n");
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
    constexpr std::string_view kTwoEach = " (\n"
                                          "            elementSize = 2\n"
                                          "            interpolation = \"vertex\"\n"
                                          "        )\n";
    const auto joint_of = [&](std::uint64_t i) {
        return motion.skin.joint_of(mesh.segments[i / 2][i % 2]);
    };
    const std::uint64_t count = 2 * std::uint64_t{mesh.segments.size()};
    put_list(out, "int[] primvars:skel:jointIndices", count,
             [&](std::uint64_t i, char* at) { return put_number(at, std::uint64_t{joint_of(i)}); });
    out.put(kTwoEach);
    put_list(out, "float[] primvars:skel:jointWeights", count, [&](std::uint64_t i, char* at) {
        const bool shared = joint_of(i / 2 * 2) != joint_of(i / 2 * 2 + 1);
        return put_text(at, shared ? "0.5" : i % 2 == 0 ? "1" : "0");
    });
    out.put(kTwoEach);
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
    put_joint_names(motion.skin, "        uniform token[] joints = ", out);
    put_places(motion, "        uniform matrix4d[] bindTransforms = ", out);
    put_places(motion, "        uniform matrix4d[] restTransforms = ", out);
    out.put(fmt::format("        rel skel:animationSource = <{}/Skeleton/Motion>\n\n"
                        "        def SkelAnimation \"Motion\"\n"
                        "        {{\n",
                        root));
    put_joint_names(motion.skin, "            uniform token[] joints = ", out);
    put_samples(motion, "float3[] translations", "(0, 0, 0)", out,
                [&](std::uint32_t frame, std::size_t moving) {
                    const glm::vec3& base =
                        motion.poses.frame(frame)[motion.skin.segments[moving]].base;
                    out.used(put_tuple<3>(out.room(kUsdaItemBytes), {base.x, base.y, base.z}));
                });
    // As joint_rotations(): consecutive ones on one side.
    std::vector<glm::quat> last(motion.skin.segments.size(), glm::quat(0.0F, 0.0F, 0.0F, 0.0F));
    put_samples(
        motion, "quatf[] rotations", "(1, 0, 0, 0)", out,
        [&](std::uint32_t frame, std::size_t moving) {
            const SegmentPlace& place = motion.poses.frame(frame)[motion.skin.segments[moving]];
            const glm::quat turn(glm::normalize(glm::dquat(place.frame)));
            const glm::quat q = glm::dot(last[moving], turn) < 0.0F ? -turn : turn;
            last[moving] = q;
            out.used(put_tuple<4>(out.room(kUsdaItemBytes + kNumberBytes), {q.w, q.x, q.y, q.z}));
        });
    put_items(out, "            half3[] scales = ", motion.skin.joint_count(),
              [&](std::size_t) { out.put("(1, 1, 1)"); });
    out.put("\n        }\n    }\n");
}

} // namespace lsys
