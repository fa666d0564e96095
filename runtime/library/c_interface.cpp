// SPDX-License-Identifier: MIT
// The C interface, on top of the C++ interface. No exception leaves it.
#include "runtime/library/impl/c_interface.h"

#include <lsys/export.h>

using namespace lsys::v0::c;

namespace {

static_assert(static_cast<int>(api::Status::Cancelled) == LSYS_CANCELLED);
static_assert(static_cast<int>(api::Status::Diagnosed) == LSYS_DIAGNOSED);
static_assert(static_cast<int>(api::Severity::Error) == LSYS_ERROR);
static_assert(sizeof(lsys_segment) == sizeof(api::Segment));
static_assert(offsetof(lsys_segment, frame) == offsetof(api::Segment, frame));
static_assert(offsetof(lsys_segment, parent) == offsetof(api::Segment, parent));
static_assert(offsetof(lsys_segment, flags) == offsetof(api::Segment, flags));

} // namespace

const char* lsys_version(void) {
    return api::version();
}

const char* lsys_status_text(lsys_status status) {
    return api::text_of(static_cast<api::Status>(status));
}

std::size_t lsys_messages_count(const lsys_messages* messages) {
    return messages->value.all().size();
}

lsys_message lsys_messages_get(const lsys_messages* messages, std::size_t index) {
    const api::Diagnostic& from = messages->value.all()[index];
    lsys_message message{};
    message.severity = static_cast<lsys_severity>(from.severity);
    message.code = from.code.c_str();
    message.text = from.message.c_str();
    message.file = from.place ? from.place->file.c_str() : "";
    if (from.place) {
        message.line = from.place->line;
        message.column = from.place->column;
        message.end_line = from.place->end_line;
        message.end_column = from.place->end_column;
    }
    return message;
}

const char* lsys_messages_text(const lsys_messages* messages) {
    return messages->text.c_str();
}

void lsys_messages_free(lsys_messages* messages) {
    delete messages;
}

lsys_status lsys_compile_file(const char* path,
                              const lsys_grammar_options* options,
                              const lsys_project* project,
                              lsys_grammar** grammar,
                              lsys_messages** messages) {
    return call([&] { return api::compile_file(path, options_of(options), project_of(project)); },
                grammar, messages);
}

lsys_status lsys_compile_text(const char* text,
                              std::size_t size,
                              const char* name,
                              const lsys_grammar_options* options,
                              const lsys_project* project,
                              lsys_grammar** grammar,
                              lsys_messages** messages) {
    return call(
        [&] {
            return api::compile_text(std::string(text, size), text_or(name, "grammar.lsys"),
                                     options_of(options), project_of(project));
        },
        grammar, messages);
}

std::int64_t lsys_grammar_generations(const lsys_grammar* grammar) {
    const std::optional<std::uint32_t> generations = grammar->value.generations();
    return generations ? static_cast<std::int64_t>(*generations) : -1;
}

std::uint64_t lsys_grammar_seed(const lsys_grammar* grammar) {
    return grammar->value.seed();
}

void lsys_grammar_free(lsys_grammar* grammar) {
    delete grammar;
}

lsys_status lsys_derive(const lsys_grammar* grammar,
                        std::int64_t generations,
                        const std::uint64_t* seed,
                        const lsys_project* project,
                        lsys_word** word,
                        lsys_messages** messages) {
    return call(
        [&] {
            return api::derive(grammar->value, {generations_of(generations), seed_of(seed)},
                               project_of(project));
        },
        word, messages);
}

std::uint64_t lsys_word_size(const lsys_word* word) {
    return word->value.size();
}

const void* lsys_word_codes(const lsys_word* word) {
    return word->value.codes();
}

std::uint32_t lsys_word_code_bytes(const lsys_word* word) {
    return word->value.code_bytes();
}

const float* lsys_word_parameters(const lsys_word* word) {
    return word->value.parameters().data();
}

std::uint64_t lsys_word_parameter_count(const lsys_word* word) {
    return word->value.parameters().size();
}

std::uint32_t lsys_word_kind_count(const lsys_word* word) {
    return static_cast<std::uint32_t>(word->value.kinds().size());
}

lsys_module_kind lsys_word_kind(const lsys_word* word, std::uint32_t code) {
    const api::ModuleKind& kind = word->value.kinds()[code];
    return {kind.name.c_str(), kind.stored_parameters, kind.constants.data(),
            kind.constants.size()};
}

lsys_status lsys_word_text(const lsys_word* word,
                           int (*write)(void* user, const char* piece, std::size_t size),
                           void* user) {
    try {
        return word->value.write_text(piece_writer(write, user)) ? LSYS_OK : LSYS_CANCELLED;
    } catch (...) {
        return LSYS_OUT_OF_MEMORY;
    }
}

void lsys_word_free(lsys_word* word) {
    delete word;
}

lsys_status lsys_grow(const lsys_grammar* grammar,
                      std::int64_t generations,
                      const std::uint64_t* seed,
                      const lsys_project* project,
                      lsys_plant** plant,
                      lsys_messages** messages) {
    return call(
        [&] {
            api::GrowOptions options;
            options.generations = generations_of(generations);
            options.seed = seed_of(seed);
            return api::grow(grammar->value, options, project_of(project));
        },
        plant, messages);
}

const lsys_segment* lsys_plant_segments(const lsys_plant* plant) {
    return reinterpret_cast<const lsys_segment*>(plant->value.segments().data());
}

std::size_t lsys_plant_segment_count(const lsys_plant* plant) {
    return plant->value.segments().size();
}

void lsys_plant_free(lsys_plant* plant) {
    delete plant;
}

lsys_status lsys_make_mesh(const lsys_plant* plant,
                           std::uint32_t sides,
                           const lsys_project* project,
                           lsys_mesh** mesh,
                           lsys_messages** messages) {
    return call(
        [&] {
            api::MeshOptions options;
            options.sides = sides;
            return api::make_mesh(plant->value, options, project_of(project));
        },
        mesh, messages);
}

std::uint64_t lsys_mesh_vertex_count(const lsys_mesh* mesh) {
    return mesh->value.positions().size();
}

std::uint64_t lsys_mesh_index_count(const lsys_mesh* mesh) {
    return mesh->value.index_count();
}

const float* lsys_mesh_positions(const lsys_mesh* mesh) {
    return reinterpret_cast<const float*>(mesh->value.positions().data());
}

const float* lsys_mesh_normals(const lsys_mesh* mesh) {
    return reinterpret_cast<const float*>(mesh->value.normals().data());
}

const float* lsys_mesh_texture_coordinates(const lsys_mesh* mesh) {
    return reinterpret_cast<const float*>(mesh->value.texture_coordinates().data());
}

void lsys_mesh_read_indices(const lsys_mesh* mesh,
                            std::uint64_t first,
                            std::uint64_t count,
                            std::uint32_t* to) {
    mesh->value.read_indices(first, count, to);
}

std::size_t lsys_mesh_part_count(const lsys_mesh* mesh) {
    return mesh->value.parts().size();
}

lsys_mesh_part lsys_mesh_get_part(const lsys_mesh* mesh, std::size_t index) {
    const api::MeshPart& part = mesh->value.parts()[index];
    const api::Material& material = mesh->value.materials()[part.material];
    const api::Vector4& colour = material.colour;
    return {part.first_index,      part.index_count,
            material.name.c_str(), {colour.x, colour.y, colour.z, colour.w},
            material.roughness,    material.two_sided ? 1 : 0};
}

lsys_status lsys_export(const lsys_plant* plant,
                        const lsys_mesh* mesh,
                        const char* format,
                        int (*write)(void* user, const char* piece, std::size_t size),
                        void* user,
                        const lsys_project* project,
                        lsys_messages** messages) {
    return call_without_value(
        [&] {
            return api::export_plant(plant->value, mesh->value, format, piece_writer(write, user),
                                     {}, project_of(project));
        },
        messages);
}

void lsys_mesh_free(lsys_mesh* mesh) {
    delete mesh;
}
