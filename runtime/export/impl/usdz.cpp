// SPDX-License-Identifier: MIT
#include "runtime/export/impl/usdz.h"

#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/stored_zip.h"

namespace lsys {

Outcome<void> write_usdz_archive(const UsdzContents& contents, PieceWriter& out) {
    EntrySize layer;
    {
        const ByteSink measure = [&layer, &out](std::string_view piece) {
            layer.add(piece);
            return !out.stopped();
        };
        PieceWriter measured(measure);
        contents.put_layer(measured);
        static_cast<void>(measured.finish());
    }
    const std::vector<std::string> pictures = encode_pictures(contents.pictures, contents.threads);
    std::vector<EntrySize> sizes{layer};
    std::uint64_t name_bytes = contents.name.size();
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        sizes.emplace_back().add(pictures[i]);
        name_bytes += contents.pictures[i].name.size();
    }
    if (!StoredZip::holds(sizes, name_bytes)) {
        return too_large_for_format(contents.subject);
    }
    // The first entry is the layer that readers open.
    StoredZip archive(out);
    archive.begin_entry(contents.name, layer);
    contents.put_layer(out);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        archive.begin_entry(contents.pictures[i].name, sizes[i + 1]);
        out.put(pictures[i]);
    }
    archive.finish();
    return finish(out);
}

} // namespace lsys
