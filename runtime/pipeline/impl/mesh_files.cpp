// SPDX-License-Identifier: MIT
#include "runtime/pipeline/impl/mesh_files.h"

#include "grammar/base/paths.h"
#include "grammar/base/source.h"
#include "runtime/meshing/patch_file.h"
#include "runtime/meshing/texture.h"
#include "runtime/meshing/user_mesh.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/impl/relative_path_help.h"
#include "runtime/pipeline/step.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace lsys {

namespace {

constexpr std::uint64_t kMaxPictureBytes = std::uint64_t{1} << 30;

std::string beside(const std::string& path, const std::string& name) {
    return path_text(path_of(path).parent_path() / path_of(name));
}

/// A material file (.mtl) that has been read.
struct MaterialLibrary {
    std::string path;
    std::string text;
    std::unordered_map<std::string, MaterialPicture> materials;
    FileId file = kNoFile; // id in PictureSearch::sources; kNoFile before the first diagnostic
};

/// Reads a picture. `max_bytes`: limit of the file and its texels together.
Result<Texture>
read_picture_file(const std::string& path, std::uint64_t max_bytes, const Project& project) {
    const Result<std::string> bytes =
        project.host.read_referenced_file(path, {kMaxPictureBytes, max_bytes});
    if (!bytes) {
        return Error{fmt::format("cannot read `{}`: {}", shown_path(path), bytes.error().message),
                     bytes.error().kind};
    }
    Result<Texture> picture = read_picture(bytes.value(), max_bytes - bytes.value().size());
    if (!picture) {
        return Error{fmt::format("cannot use `{}`: {}", shown_path(path), picture.error().message),
                     picture.error().kind};
    }
    return picture;
}

bool is_picture(const std::string& path) {
    const std::string extension = path_text(path_of(path).extension());
    return extension.size() == 4 && (extension == ".png" || extension == ".PNG");
}

/// A rectangle with the picture: upright along the turtle's heading, 1 high, and facing the
/// turtle's up vector.
UserMesh card_of(const Texture& picture) {
    const float half =
        0.5F * static_cast<float>(picture.width) / static_cast<float>(picture.height);
    UserMesh card;
    card.positions = {{-half, 0, 0}, {half, 0, 0}, {half, 1, 0}, {-half, 1, 0}};
    card.normals.assign(4, {0, 0, 1});
    card.texture_coordinates = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    card.indices = {0, 1, 2, 0, 2, 3};
    return card;
}

/// Finds and reads the pictures of `mesh`, which the file `path` with the contents `text` defines.
class PictureSearch {
public:
    PictureSearch(const std::string& path,
                  const std::string& text,
                  FileBudget& budget,
                  UserMesh& mesh)
        : path_(path), text_(text), budget_(budget), mesh_(mesh),
          held_(text.size() + mesh.byte_count()) {}

    void read_pictures(const Project& project) {
        for (const ObjName& name : mesh_.libraries) {
            MaterialLibrary library{beside(path_, name.name), {}, {}};
            Result<std::string> read =
                project.host.read_referenced_file(library.path, {kMaxSourceBytes, left()});
            if (!read) {
                report(path_, text_, obj_, name,
                       Error{fmt::format("cannot read `{}`: {}", shown_path(library.path),
                                         read.error().message),
                             read.error().kind});
                if (read.error().kind == ErrorKind::Limit) {
                    return;
                }
                continue;
            }
            library.text = std::move(read.value());
            held_ += library.text.size();
            library.materials = pictures_of(library.text, mesh_.materials);
            libraries_.push_back(std::move(library));
        }
        if (libraries_.empty()) {
            return;
        }
        if (mesh_.materials.empty()) {
            return;
        }
        const FoundPicture first = find(mesh_.materials.front());
        for (const ObjName& material : mesh_.materials) {
            if (find(material).path != first.path) {
                warn(path_, text_, obj_, material,
                     "the faces have several pictures; the whole mesh shows the picture of its "
                     "first face");
                break;
            }
        }
        if (!first.path.empty()) {
            read(first, project);
        }
    }

    Diagnostics diagnostics;
    bool has_limit = false; // a picture has exceeded the memory limit
    std::shared_ptr<SourceMap> sources = std::make_shared<SourceMap>();

private:
    [[nodiscard]] std::uint64_t left() const {
        return budget_.left - std::min(budget_.left, held_);
    }

    /// Reports `error` at the place of `name` in `text`: as an error if it is a memory limit, else
    /// as a warning.
    void report(const std::string& path,
                const std::string& text,
                FileId& file,
                const ObjName& name,
                const Error& error) {
        const bool is_limit = error.kind == ErrorKind::Limit;
        const DiagnosticCode code =
            is_limit ? DiagnosticCode::LimitReached : DiagnosticCode::MeshPicture;
        if (!diagnostics.admits(code)) {
            return;
        }
        SourceSpan span;
        std::string message = error.message;
        if (text.size() > kMaxSourceBytes) {
            message = fmt::format("{}: {}", shown_path(path), message);
        } else {
            if (file == kNoFile) {
                file = sources->add(shown_path(path), text);
            }
            const auto begin = static_cast<std::uint32_t>(name.offset);
            span = {file, begin, begin + static_cast<std::uint32_t>(name.name.size())};
        }
        Diagnostic& added = diagnostics.add(code, span, std::move(message));
        if (is_limit) {
            has_limit = true;
            added.help.emplace_back("raise the limit with `--max-memory`");
        }
    }
    void warn(const std::string& path,
              const std::string& text,
              FileId& file,
              const ObjName& name,
              std::string message) {
        report(path, text, file, name, Error{std::move(message)});
    }

    /// The pictures of a material. `path`: the first of them; empty if the material has no picture.
    struct FoundPicture {
        std::string path;
        MaterialLibrary* library = nullptr;
        const MaterialPicture* picture = nullptr;
    };
    FoundPicture find(const ObjName& material) {
        if (material.name.empty()) {
            return {};
        }
        for (MaterialLibrary& library : libraries_) {
            const auto found = library.materials.find(material.name);
            if (found == library.materials.end()) {
                continue;
            }
            const MaterialPicture& picture = found->second;
            const ObjName& first = picture.file.name.empty() ? picture.normal_map : picture.file;
            return {first.name.empty() ? std::string() : beside(library.path, first.name), &library,
                    &picture};
        }
        if (libraries_.size() == mesh_.libraries.size() &&
            !std::exchange(reported_unknown_, true)) {
            warn(path_, text_, obj_, material,
                 fmt::format("no file of materials has `{}`", material.name));
        }
        return {};
    }

    void read(const FoundPicture& found, const Project& project) {
        MaterialLibrary& library = *found.library;
        const MaterialPicture& names = *found.picture;
        const ObjName& first = names.file.name.empty() ? names.normal_map : names.file;
        std::shared_ptr<const Texture> colour = load(library, names.file, project);
        std::shared_ptr<const Texture> normal_map = load(library, names.normal_map, project);
        if (colour == nullptr && normal_map == nullptr) {
            return;
        }
        if (names.has_options) {
            warn(library.path, library.text, library.file, first,
                 "options before the name of a picture are left out");
        }
        if (mesh_.texture_coordinates.empty()) {
            warn(library.path, library.text, library.file, first,
                 fmt::format("`{}` has no texture coordinates to show this picture by",
                             shown_path(path_)));
            return;
        }
        if (colour != nullptr && !names.opacity.name.empty() &&
            names.opacity.name != names.file.name) {
            colour = add_opacity(library, names, colour, project);
        }
        mesh_.picture = std::move(colour);
        if (normal_map != nullptr) {
            mesh_.normal_map =
                derived(fmt::format("{}\nrelief {}", beside(library.path, names.normal_map.name),
                                    names.bump),
                        [&] { return normals_of(*normal_map, names.bump); });
        }
    }

    std::shared_ptr<const Texture> add_opacity(MaterialLibrary& library,
                                               const MaterialPicture& names,
                                               const std::shared_ptr<const Texture>& colour,
                                               const Project& project) {
        const std::shared_ptr<const Texture> opacity = load(library, names.opacity, project);
        if (opacity == nullptr) {
            return colour;
        }
        if (opacity->width != colour->width || opacity->height != colour->height) {
            warn(library.path, library.text, library.file, names.opacity,
                 fmt::format("an opacity of {} by {} pixels for a picture of {} by {} is left out",
                             opacity->width, opacity->height, colour->width, colour->height));
            return colour;
        }
        return derived(fmt::format("{}\nopacity {}", beside(library.path, names.file.name),
                                   beside(library.path, names.opacity.name)),
                       [&] { return with_opacity(*colour, *opacity); });
    }

    /// A picture that `make` computes from other pictures, cached under `key`. Keys contain a line
    /// break, so that they differ from paths.
    template <typename Make>
    std::shared_ptr<const Texture> derived(const std::string& key, const Make& make) {
        std::shared_ptr<const Texture>& picture = budget_.pictures[key];
        if (picture == nullptr) {
            picture = std::make_shared<const Texture>(make());
            budget_.take(picture->texels.size());
        }
        return picture;
    }

    /// Loads a picture. Returns null if the name is empty, or after reporting that it cannot be
    /// read.
    std::shared_ptr<const Texture>
    load(MaterialLibrary& library, const ObjName& name, const Project& project) {
        if (name.name.empty()) {
            return nullptr;
        }
        const std::string path = beside(library.path, name.name);
        std::shared_ptr<const Texture>& picture = budget_.pictures[path];
        if (picture == nullptr) {
            Result<Texture> decoded = decode(path, project);
            if (!decoded) {
                report(library.path, library.text, library.file, name, decoded.error());
                return nullptr;
            }
            budget_.take(decoded.value().texels.size());
            picture = std::make_shared<const Texture>(std::move(decoded.value()));
        }
        return picture;
    }

    Result<Texture> decode(const std::string& path, const Project& project) const {
        return read_picture_file(path, left(), project);
    }

    const std::string& path_;
    const std::string& text_;
    FileBudget& budget_;
    UserMesh& mesh_;
    std::uint64_t held_;   // bytes in use that `budget_` does not count: texts of files, the mesh
    FileId obj_ = kNoFile; // id of the mesh file in `sources`; kNoFile before its first use
    bool reported_unknown_ = false; // whether an unknown material has been reported
    std::vector<MaterialLibrary> libraries_;
};

/// The warning or, if a limit of memory is reached, the error that a picture of a material is
/// missing.
Diagnostic picture_diagnostic(const Error& error,
                              const BytecodePicture& picture,
                              const std::filesystem::path& folder,
                              const Grammar& grammar) {
    const bool is_limit = error.kind == ErrorKind::Limit;
    Diagnostic diagnostic =
        make_diagnostic(is_limit ? DiagnosticCode::LimitReached : DiagnosticCode::MaterialPicture,
                        {}, error.message);
    if (picture.site != kNone) {
        const Site& site = grammar.bytecode.sites[picture.site];
        if (grammar.is_module_file) {
            diagnostic.notes.push_back(fmt::format(
                "at {}:{}:{}", grammar.bytecode.files[static_cast<std::size_t>(site.span.file)],
                site.line, site.column));
        } else {
            diagnostic.span = site.span;
        }
    }
    diagnostic.help.emplace_back(is_limit ? "raise the limit with `--max-memory`"
                                          : relative_path_help("#material", folder, grammar) +
                                                "; PNG, JPEG, SGI and TGA files are read");
    return diagnostic;
}

/// The error that the file of an `#object` cannot be read, or that a limit of memory is reached.
Diagnostic object_diagnostic(const Error& error,
                             const std::string& mesh_file,
                             const std::filesystem::path& folder,
                             const Grammar& grammar) {
    const bool is_limit = error.kind == ErrorKind::Limit;
    const auto place = grammar.object_spans.find(mesh_file);
    Diagnostic diagnostic = make_diagnostic(
        is_limit ? DiagnosticCode::LimitReached : DiagnosticCode::ObjectFile,
        place == grammar.object_spans.end() ? SourceSpan{} : place->second, error.message);
    diagnostic.help.emplace_back(is_limit ? "raise the limit with `--max-memory`"
                                          : relative_path_help("#object", folder, grammar));
    return diagnostic;
}

/// Reads the pictures of `#material`. A missing picture is left out with a warning.
std::optional<Stop> read_looks(const std::filesystem::path& folder,
                               const Grammar& grammar,
                               FileBudget& budget,
                               Step& step,
                               std::shared_ptr<const Looks>& looks) {
    if (grammar.bytecode.materials.empty()) {
        return std::nullopt;
    }
    std::optional<Stop> stop;
    const auto load = [&](const BytecodePicture& name) -> std::shared_ptr<const Texture> {
        if (name.path.empty() || stop) {
            return nullptr;
        }
        const std::string path =
            path_text(folder / path_of(std::string(picture_name(name.path).path)));
        std::shared_ptr<const Texture>& picture = budget.pictures[path];
        if (picture == nullptr) {
            Result<Texture> read = read_picture_file(path, budget.left, step.project());
            if (!read) {
                const bool may_go_on = step.diagnose(
                    picture_diagnostic(read.error(), name, folder, grammar), grammar.sources);
                if (read.error().kind == ErrorKind::Limit) {
                    stop = Stop::Limit;
                } else if (!may_go_on) {
                    stop = Stop::Diagnosed;
                }
                return nullptr;
            }
            budget.take(read.value().texels.size());
            picture = std::make_shared<const Texture>(std::move(read.value()));
        }
        return picture;
    };
    auto all = std::make_shared<Looks>();
    for (const BytecodeMaterial& material : grammar.bytecode.materials) {
        Look look;
        if (material.has_colour) {
            look.colour = {linear_of_srgb(material.colour[0]), linear_of_srgb(material.colour[1]),
                           linear_of_srgb(material.colour[2])};
        }
        look.picture = load(material.picture);
        const std::optional<float> ratio = picture_name(material.picture.path).ratio;
        if (look.picture != nullptr && ratio) {
            look.picture_length = *ratio * static_cast<float>(look.picture->height) /
                                  static_cast<float>(look.picture->width);
        }
        look.normal_map = load(material.normal);
        if (stop) {
            return stop;
        }
        if (material.has_roughness) {
            look.roughness = material.roughness;
        }
        if (material.has_translucency) {
            look.translucency = material.translucency;
        }
        if (material.has_sides) {
            look.two_sided = material.two_sided;
        }
        add_look(material.index, std::move(look), *all);
    }
    looks = std::move(all);
    return std::nullopt;
}

} // namespace

Outcome<MeshFiles> read_mesh_files(const std::string& grammar_file,
                                   const Grammar& grammar,
                                   const Project& project,
                                   FileBudget& budget) {
    Step step(project);
    MeshFiles files;
    bool ok = true;
    const Bytecode& bytecode = grammar.bytecode;
    const std::filesystem::path folder = path_of(grammar_file).parent_path();
    if (const std::optional<Stop> stop = read_looks(folder, grammar, budget, step, files.looks)) {
        return step.end(*stop);
    }
    for (std::size_t i = 0; i < bytecode.symbols.size(); ++i) {
        const BytecodeSymbol& symbol = bytecode.symbols[i];
        const bool is_polygon_picture =
            symbol.turtle == TurtleOperation::PolygonBegin && !symbol.mesh_file.empty();
        if (symbol.turtle != TurtleOperation::MeshFile && !is_polygon_picture) {
            continue;
        }
        const std::string path = path_text(folder / path_of(path_of_object(symbol.mesh_file)));
        const auto fail = [&](const Error& error) {
            if (project.is_cancelled()) {
                return step.end(Stop::Cancelled);
            }
            static_cast<void>(step.diagnose(
                object_diagnostic(error, symbol.mesh_file, folder, grammar), grammar.sources));
            return step.end(error.kind == ErrorKind::Limit ? Stop::Limit : Stop::Diagnosed);
        };
        if (is_polygon_picture || is_picture(path)) {
            std::shared_ptr<const Texture>& picture = budget.pictures[path];
            if (picture == nullptr) {
                Result<Texture> read = read_picture_file(path, budget.left, project);
                if (!read) {
                    return fail(read.error());
                }
                budget.take(read.value().texels.size());
                picture = std::make_shared<const Texture>(std::move(read.value()));
            }
            UserMesh& mesh =
                files.meshes.emplace_back(is_polygon_picture ? UserMesh{} : card_of(*picture));
            mesh.picture = picture;
            budget.take(mesh.byte_count());
            files.lengths.resize(bytecode.symbols.size(), 1.0F);
            continue;
        }
        const Result<std::string> text =
            step.read_referenced(path, {~std::uint64_t{0}, budget.left});
        if (!text) {
            return fail(text.error());
        }
        Result<UserMesh> mesh =
            read_object_file(symbol.mesh_file, text.value(), budget.left - text.value().size());
        if (!mesh) {
            return fail(Error{fmt::format("cannot use `{}`: {}", path, mesh.error().message),
                              mesh.error().kind});
        }
        PictureSearch search(path, text.value(), budget, mesh.value());
        search.read_pictures(project);
        const bool has_limit = search.has_limit;
        ok = step.diagnose(std::move(search.diagnostics), search.sources) && ok;
        if (has_limit) {
            return step.end(Stop::Limit);
        }
        budget.take(mesh.value().byte_count());
        files.lengths.resize(bytecode.symbols.size(), 1.0F);
        files.lengths[i] = mesh.value().length();
        files.meshes.push_back(std::move(mesh.value()));
    }
    return ok ? step.done(std::move(files)) : step.end(Stop::Diagnosed);
}

} // namespace lsys
