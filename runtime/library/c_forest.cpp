// SPDX-License-Identifier: MIT
// The C interface of files and forests.
#include "runtime/library/impl/c_interface.h"

#include <lsys/export.h>
#include <lsys/forest.h>
#include <new>
#include <span>
#include <vector>

using namespace lsys::v0::c;

namespace {

static_assert(sizeof(lsys_tree) == sizeof(api::Tree));
static_assert(offsetof(lsys_tree, number) == offsetof(api::Tree, number));
static_assert(offsetof(lsys_tree, age) == offsetof(api::Tree, age));
static_assert(sizeof(lsys_instance) == sizeof(api::Instance));
static_assert(offsetof(lsys_instance, rotation) == offsetof(api::Instance, rotation));
static_assert(offsetof(lsys_instance, group) == offsetof(api::Instance, group));
static_assert(sizeof(lsys_instance_group) == sizeof(api::InstanceGroup));
static_assert(offsetof(lsys_instance_group, first_instance) ==
              offsetof(api::InstanceGroup, first_instance));

api::Options named_options(const lsys_option* options, std::size_t count) {
    api::Options all;
    for (std::size_t i = 0; i < count; ++i) {
        all.emplace_back(options[i].name, text_or(options[i].value, ""));
    }
    return all;
}

api::ForestOptions
forest_options(const lsys_grammar_options* grammar, const lsys_option* options, std::size_t count) {
    return {options_of(grammar), named_options(options, count)};
}

/// A C++ callback that passes files to a function of C.
api::FileReceiver receiver_of(lsys_receive receive, void* user) {
    return [receive, user](const api::FilePiece& piece) {
        return receive(user, std::string(piece.name).c_str(), piece.bytes.data(),
                       piece.bytes.size(), piece.is_last ? 1 : 0) == 0;
    };
}

} // namespace

lsys_status lsys_save_plant(const lsys_plant* plant,
                            const char* path,
                            const lsys_option* options,
                            std::size_t option_count,
                            const lsys_project* project,
                            lsys_messages** messages) {
    return call_without_value(
        [&] {
            return api::save_plant(plant->value, path, named_options(options, option_count),
                                   project_of(project));
        },
        messages);
}

lsys_status lsys_write_plant(const lsys_plant* plant,
                             const char* name,
                             const lsys_option* options,
                             std::size_t option_count,
                             lsys_receive receive,
                             void* user,
                             const lsys_project* project,
                             lsys_messages** messages) {
    return call_without_value(
        [&] {
            return api::write_plant(plant->value, name, receiver_of(receive, user),
                                    named_options(options, option_count), project_of(project));
        },
        messages);
}

lsys_status lsys_grow_forest(const char* const* files,
                             std::size_t file_count,
                             const lsys_grammar_options* grammar_options,
                             const lsys_option* options,
                             std::size_t option_count,
                             const lsys_project* project,
                             lsys_forest** forest,
                             lsys_messages** messages) {
    return call(
        [&] {
            return api::grow_forest(std::vector<std::string>(files, files + file_count),
                                    forest_options(grammar_options, options, option_count),
                                    project_of(project));
        },
        forest, messages);
}

lsys_status lsys_forest_of_places(const char* const* grammars,
                                  std::size_t grammar_count,
                                  const lsys_tree* places,
                                  std::size_t place_count,
                                  const lsys_grammar_options* grammar_options,
                                  const lsys_option* options,
                                  std::size_t option_count,
                                  const lsys_project* project,
                                  lsys_forest** forest,
                                  lsys_messages** messages) {
    return call(
        [&] {
            return api::forest_of_places(
                std::vector<std::string>(grammars, grammars + grammar_count),
                {reinterpret_cast<const api::Tree*>(places), place_count},
                forest_options(grammar_options, options, option_count), project_of(project));
        },
        forest, messages);
}

const lsys_tree* lsys_forest_trees(const lsys_forest* forest) {
    return reinterpret_cast<const lsys_tree*>(forest->value.trees().data());
}

std::size_t lsys_forest_tree_count(const lsys_forest* forest) {
    return forest->value.trees().size();
}

lsys_status lsys_save_forest(const lsys_forest* forest,
                             const char* path,
                             const lsys_option* options,
                             std::size_t option_count,
                             const lsys_project* project,
                             lsys_messages** messages) {
    return call_without_value(
        [&] {
            return api::save_forest(forest->value, path, named_options(options, option_count),
                                    project_of(project));
        },
        messages);
}

lsys_status lsys_write_forest(const lsys_forest* forest,
                              const char* name,
                              const lsys_option* options,
                              std::size_t option_count,
                              lsys_receive receive,
                              void* user,
                              const lsys_project* project,
                              lsys_messages** messages) {
    return call_without_value(
        [&] {
            return api::write_forest(forest->value, name, receiver_of(receive, user),
                                     named_options(options, option_count), project_of(project));
        },
        messages);
}

void lsys_forest_free(lsys_forest* forest) {
    delete forest;
}

lsys_status lsys_make_instances(const lsys_forest* forest,
                                std::uint32_t sides,
                                const lsys_project* project,
                                lsys_instances** instances,
                                lsys_messages** messages) {
    return call(
        [&] {
            api::MeshOptions options;
            options.sides = sides;
            return api::make_instances(forest->value, options, project_of(project));
        },
        instances, messages);
}

const lsys_instance* lsys_instances_all(const lsys_instances* instances) {
    return reinterpret_cast<const lsys_instance*>(instances->value.all().data());
}

std::uint64_t lsys_instances_count(const lsys_instances* instances) {
    return instances->value.all().size();
}

const lsys_instance_group* lsys_instances_groups(const lsys_instances* instances) {
    return reinterpret_cast<const lsys_instance_group*>(instances->value.groups().data());
}

std::size_t lsys_instances_group_count(const lsys_instances* instances) {
    return instances->value.groups().size();
}

std::size_t lsys_instances_mesh_count(const lsys_instances* instances) {
    return instances->value.meshes().size();
}

lsys_mesh* lsys_instances_mesh(const lsys_instances* instances, std::size_t index) {
    return new (std::nothrow) lsys_mesh{instances->value.meshes()[index]};
}

void lsys_instances_read_matrices(const lsys_instances* instances,
                                  std::uint64_t first,
                                  std::uint64_t count,
                                  void* to,
                                  std::size_t stride) {
    instances->value.read_matrices(first, count, to, stride);
}

void lsys_instances_free(lsys_instances* instances) {
    delete instances;
}
