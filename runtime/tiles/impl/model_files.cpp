// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/model_files.h"

#include "runtime/export/export.h"

#include <fmt/format.h>

#include <map>
#include <new>
#include <utility>

namespace lsys {

namespace {

/// Size in bytes at which a file ends, so that clients get the models of a forest of many species
/// in pieces.
constexpr std::size_t kModelFileBytes = std::size_t{1} << 20;
constexpr std::size_t kAlignment = 8; // bytes, of the models in a file

class ModelWriter {
public:
    explicit ModelWriter(std::size_t heroes) { made_.models.resize(heroes); }

    ModelFiles write(const std::vector<Hero>& heroes,
                     const std::vector<std::string>& names,
                     const LevelPlan& plan,
                     const std::string& generator) {
        for (std::size_t i = 0; i < heroes.size(); ++i) {
            made_.models[i].resize(heroes[i].levels.levels.size());
        }
        for (std::uint32_t level = plan.first_tree_level; level <= plan.finest(); ++level) {
            level_ = level;
            part_ = 0;
            for (std::size_t i = 0; i < heroes.size(); ++i) {
                const std::size_t detail = plan.details[level].detail[i];
                if (detail == kNotShown) {
                    continue;
                }
                const Mesh& mesh = heroes[i].meshes[detail];
                MeshDocument& model = made_.models[i][detail];
                if (model.json.is_null() && !mesh.positions.empty()) {
                    model = add(mesh, tile_part_info(names[i], generator));
                    waiting_.push_back(&model);
                    if (buffer_.size() + waiting_bytes_ >= kModelFileBytes) {
                        end_file();
                    }
                }
            }
            end_file();
        }
        for (std::vector<MeshDocument>& details : made_.models) {
            for (MeshDocument& model : details) {
                complete(model);
            }
        }
        return std::move(made_);
    }

private:
    [[nodiscard]] std::string path() const {
        return fmt::format("models/{}-{}.bin", level_, part_);
    }
    /// Adds bytes to the current file and returns their place. complete() sets the size of the file
    /// later.
    FilePart put(const std::string& bytes) {
        FilePart part{"../../" + path(), 0, buffer_.size(), bytes.size()};
        buffer_ += bytes;
        buffer_.resize((buffer_.size() + kAlignment - 1) / kAlignment * kAlignment, '\0');
        return part;
    }
    /// Makes the document of a mesh and puts its pictures into the current file.
    MeshDocument add(const Mesh& mesh, const ExportInfo& info) {
        MeshDocument model = make_mesh_document(mesh, info);
        waiting_bytes_ += model.data.size();
        std::map<std::string, FilePart> parts; // by the name of the picture in the document
        for (const PictureFile& picture : tile_pictures(mesh)) {
            auto known = pictures_.find(picture.bytes);
            if (known == pictures_.end()) {
                known = pictures_.emplace(picture.bytes, put(picture.bytes)).first;
            }
            parts[picture.name] = known->second;
        }
        for (const auto& image : model.json.value("images", nlohmann::ordered_json::array())) {
            model.pictures.push_back(parts.at(image["uri"].get<std::string>()));
        }
        return model;
    }
    void end_file() {
        join_buffers(waiting_, buffer_);
        for (MeshDocument* const model : waiting_) {
            model->uri = "../../" + path();
        }
        waiting_.clear();
        waiting_bytes_ = 0;
        if (!buffer_.empty()) {
            sizes_["../../" + path()] = buffer_.size();
            made_.files.push_back({path(), std::exchange(buffer_, {})});
            ++part_;
        }
    }
    /// Sets the sizes of the files that `model` refers to, which are known only when the files are
    /// complete.
    void complete(MeshDocument& model) const {
        if (model.json.is_null()) {
            return;
        }
        model.file_bytes = sizes_.at(model.uri);
        for (FilePart& picture : model.pictures) {
            picture.file_bytes = sizes_.at(picture.uri);
        }
    }

    ModelFiles made_;
    std::uint32_t level_ = 0;                    // level of the quadtree of the file
    std::size_t part_ = 0;                       // number of the current file within the level
    std::string buffer_;                         // pictures of the current file, then its meshes
    std::vector<MeshDocument*> waiting_;         // meshes that end_file() adds to the current file
    std::size_t waiting_bytes_ = 0;              // bytes of `waiting_` before join_buffers()
    std::map<std::string, FilePart> pictures_;   // places of pictures, by the bytes of the picture
    std::map<std::string, std::uint64_t> sizes_; // sizes of the files, by URI
};

} // namespace

ExportInfo tile_part_info(const std::string& name, const std::string& generator) {
    ExportInfo info;
    info.name = name;
    info.generator = generator;
    info.compression = ExportCompression::Meshopt;
    info.buffer_name = "buffer";
    info.picture_prefix = "picture";
    info.threads = 1;
    return info;
}

std::vector<PictureFile> tile_pictures(const Mesh& mesh) {
    Outcome<std::vector<PictureFile>> pictures =
        make_picture_files(mesh, ExportFormat::Gltf, tile_part_info("", ""));
    if (!pictures) {
        throw std::bad_alloc(); // the only reason for which make_picture_files() stops
    }
    return std::move(pictures.value());
}

ModelFiles make_model_files(const std::vector<Hero>& heroes,
                            const std::vector<std::string>& names,
                            const LevelPlan& plan,
                            const std::string& generator) {
    return ModelWriter(heroes.size()).write(heroes, names, plan, generator);
}

} // namespace lsys
