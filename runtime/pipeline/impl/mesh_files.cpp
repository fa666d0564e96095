#include "runtime/pipeline/impl/mesh_files.h"

#include "grammar/base/source.h"
#include "runtime/meshing/texture.h"
#include "runtime/meshing/user_mesh.h"
#include "runtime/pipeline/grammar.h"
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
    return (std::filesystem::path(path).parent_path() / name).string();
}

/// A material file that could be read.
struct MaterialLibrary {
    std::string path;
    std::string text;
    std::unordered_map<std::string, MaterialPicture> materials;
    FileId file = kNoFile; // kNoFile until its first diagnostic
};

/// Finds and reads the picture of the mesh in the file `path`, whose contents are `text`.
class PictureSearch {
public:
    PictureSearch(const std::string& path,
                  const std::string& text,
                  FileBudget& budget,
                  UserMesh& mesh)
        : path_(path), text_(text), budget_(budget), mesh_(mesh),
          held_(text.size() + mesh.byte_count()) {}

    void run(const Project& project) {
        for (const ObjName& name : mesh_.libraries) {
            MaterialLibrary library{beside(path_, name.name), {}, {}};
            Result<std::string> read =
                project.host.read_named_file(library.path, {kMaxSourceBytes, left()});
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
                     "faces of several pictures: all of the mesh looks as its first face");
                break;
            }
        }
        if (!first.path.empty()) {
            read(first, project);
        }
    }

    Diagnostics diagnostics;
    bool has_limit = false; // a picture needed too much memory
    std::shared_ptr<SourceMap> sources = std::make_shared<SourceMap>();

private:
    [[nodiscard]] std::uint64_t left() const {
        return budget_.left - std::min(budget_.left, held_);
    }

    /// Reports `error` at the place of `name` in `text`, as an error if a limit of memory is
    /// reached, else as a warning.
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

    /// The picture of a material; an empty path if it has none.
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
            return {picture.file.name.empty() ? std::string()
                                              : beside(library.path, picture.file.name),
                    &library, &picture};
        }
        if (libraries_.size() == mesh_.libraries.size() &&
            !std::exchange(reported_unknown_, true)) {
            warn(path_, text_, obj_, material,
                 fmt::format("no file of materials has `{}`", material.name));
        }
        return {};
    }

    void read(const FoundPicture& found, const Project& project) {
        const std::string& path = found.path;
        const auto add_note = [&](std::string message) {
            MaterialLibrary& library = *found.library;
            warn(library.path, library.text, library.file, found.picture->file, std::move(message));
        };
        std::shared_ptr<const Texture> picture = budget_.pictures[path];
        if (picture == nullptr) {
            Result<Texture> decoded = decode(path, project);
            if (!decoded) {
                MaterialLibrary& library = *found.library;
                report(library.path, library.text, library.file, found.picture->file,
                       decoded.error());
                return;
            }
            budget_.take(decoded.value().texels.size());
            picture = std::make_shared<const Texture>(std::move(decoded.value()));
            budget_.pictures[path] = picture;
        }
        if (found.picture->has_options) {
            add_note("options before the name of a picture are left out");
        }
        if (mesh_.texture_coordinates.empty()) {
            add_note(fmt::format("`{}` has no texture coordinates to show this picture by",
                                 shown_path(path_)));
            return;
        }
        mesh_.picture = std::move(picture);
    }

    Result<Texture> decode(const std::string& path, const Project& project) const {
        const Result<std::string> bytes =
            project.host.read_named_file(path, {kMaxPictureBytes, left()});
        if (!bytes) {
            return Error{
                fmt::format("cannot read `{}`: {}", shown_path(path), bytes.error().message),
                bytes.error().kind};
        }
        Result<Texture> picture = read_picture(bytes.value(), left() - bytes.value().size());
        if (!picture) {
            return Error{
                fmt::format("cannot use `{}`: {}", shown_path(path), picture.error().message),
                picture.error().kind};
        }
        return picture;
    }

    const std::string& path_;
    const std::string& text_;
    FileBudget& budget_;
    UserMesh& mesh_;
    std::uint64_t held_; // bytes that the budget does not count: texts of files, the mesh
    FileId obj_ = kNoFile;
    bool reported_unknown_ = false;
    std::vector<MaterialLibrary> libraries_;
};

} // namespace

Outcome<MeshFiles> read_mesh_files(const std::string& grammar_file,
                                   const Bytecode& bytecode,
                                   const Project& project,
                                   FileBudget& budget) {
    Step step(project);
    MeshFiles files;
    bool ok = true;
    const std::filesystem::path folder = std::filesystem::path(grammar_file).parent_path();
    for (std::size_t i = 0; i < bytecode.symbols.size(); ++i) {
        const BytecodeSymbol& symbol = bytecode.symbols[i];
        if (symbol.turtle != TurtleOperation::MeshFile) {
            continue;
        }
        const std::string path = (folder / symbol.mesh_file).string();
        const Result<std::string> text = step.read_named(path, {~std::uint64_t{0}, budget.left});
        if (!text) {
            return step.fail(text.error());
        }
        Result<UserMesh> mesh = read_obj(text.value(), budget.left - text.value().size());
        if (!mesh) {
            return step.fail(Error{fmt::format("cannot use `{}`: {}", path, mesh.error().message),
                                   mesh.error().kind});
        }
        PictureSearch search(path, text.value(), budget, mesh.value());
        search.run(project);
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
