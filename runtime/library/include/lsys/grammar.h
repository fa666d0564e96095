// SPDX-License-Identifier: MIT
// Grammar: a compiled L-system. Read from a .lsys file, a file of another program (for example
// L-studio's cpfg, Houdini or Fractint) or a compiled .lsb file.
#pragma once

#include <cstdint>
#include <lsys/api.h>
#include <lsys/outcome.h>
#include <lsys/project.h>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys::LSYS_INTERFACE {

struct GrammarOptions {
    /// Name of a dialect, such as "lsys" or "cpfg"; empty: detected from the contents, else from
    /// the extension of the name.
    std::string dialect;
    std::string system;          // name in a file with several systems; empty: the only system
    bool bug_compatible = false; // reproduces bugs of the original program of the dialect
    /// Values of constants (`#define`, `#param`) by name.
    std::vector<std::pair<std::string, float>> definitions;
    /// Values of `#set` statements by key, in the syntax of `#set`: {"angle", "22.5"}.
    std::vector<std::pair<std::string, std::string>> settings;
    std::optional<std::uint32_t> generations; // replaces `#n`
};

/// A `#define` or `#param` of a grammar.
struct Constant {
    std::string name;
    bool is_parameter = false; // a `#param`, with bounds
    bool is_random = false;    // drawn for each seed, so it has no value
    float value = 0.0F;
    float min = 0.0F; // bounds of a `#param`
    float max = 0.0F;
};

/// Prediction of the number of modules of a word: exact if `low` equals `high`. Counts above 2^53
/// are rounded.
struct PredictedSize {
    double low = 0.0;
    double high = 0.0;
    double low_segments = 0.0; // bounds of the number of modules that draw a segment
    double high_segments = 0.0;
    std::uint64_t max_bytes = 0; // size of a word of `high` modules; saturates
};

/// A compiled grammar. Cheap to copy, immutable, safe to use from several threads at once.
class LSYS_API Grammar {
public:
    /// The file name, or the name given to compile_text().
    [[nodiscard]] const std::string& name() const;
    /// The value of GrammarOptions::generations, else of `#n`. Unset: neither is given; derivations
    /// then need DeriveOptions::generations or GrowOptions::generations.
    [[nodiscard]] std::optional<std::uint32_t> generations() const;
    [[nodiscard]] std::uint64_t seed() const;
    /// The constants in the order of the source; none for a .lsb file.
    [[nodiscard]] const std::vector<Constant>& constants() const;
    /// The .lsys text of a grammar in another dialect; empty for .lsys grammars.
    [[nodiscard]] const std::string& translation() const;
    /// The grammar as the bytes of a .lsb file.
    [[nodiscard]] std::string bytecode() const;
    /// Sizes of generations 0 to `generations`. Empty if they cannot be predicted, as with
    /// `#decompose` and `%`; fewer generations for very large programs.
    [[nodiscard]] std::vector<PredictedSize> predict(std::uint32_t generations) const;

    struct Data;
    explicit Grammar(std::shared_ptr<const Data> data) noexcept;
    [[nodiscard]] const Data& data() const { return *data_; }

private:
    std::shared_ptr<const Data> data_; // never null
};

/// Reads and compiles a file. Paths in the file are relative to its folder.
[[nodiscard]] LSYS_API Outcome<Grammar> compile_file(const std::string& path,
                                                     const GrammarOptions& options = {},
                                                     const Project& project = {});
/// Compiles `text`. `name`: file name in messages; paths in the text are relative to its folder.
[[nodiscard]] LSYS_API Outcome<Grammar> compile_text(std::string text,
                                                     const std::string& name = "grammar.lsys",
                                                     const GrammarOptions& options = {},
                                                     const Project& project = {});

} // namespace lsys::LSYS_INTERFACE
