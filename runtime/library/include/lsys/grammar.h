// Grammar: an L-system, compiled. From a .lsys file, a file of another program (L-studio's cpfg,
// Houdini, Fractint ...) or a compiled .lsb file.
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
    /// "lsys", "cpfg" ...; empty: recognised by the contents, else by the ending of the name.
    std::string dialect;
    std::string system; // of a file with several; empty: the only one
    bool bug_compatible = false;
    /// Values of constants (`#define`, `#param`) by name.
    std::vector<std::pair<std::string, float>> definitions;
    /// Values of `#set` statements by key, as written there: {"angle", "22.5"}.
    std::vector<std::pair<std::string, std::string>> settings;
    std::optional<std::uint32_t> generations; // instead of `#n`
};

/// A `#define` or `#param` of a grammar.
struct Constant {
    std::string name;
    bool is_parameter = false; // a `#param`, with bounds
    bool is_random = false;    // drawn anew for each seed: it has no value
    float value = 0.0F;
    float min = 0.0F; // of a parameter
    float max = 0.0F;
};

/// The number of modules of a word before it is derived: exact if `low` is `high`. Counts above
/// 2^53 are rounded.
struct PredictedSize {
    double low = 0.0;
    double high = 0.0;
    double low_segments = 0.0;
    double high_segments = 0.0;
    std::uint64_t max_bytes = 0; // of the word by `high`; saturates
};

/// A compiled grammar. Cheap to copy, immutable, safe to use from several threads at once.
class LSYS_API Grammar {
public:
    /// The name that it was compiled under.
    [[nodiscard]] const std::string& name() const;
    /// Of `#n` or GrammarOptions::generations; none: derivations need a number of their own.
    [[nodiscard]] std::optional<std::uint32_t> generations() const;
    [[nodiscard]] std::uint64_t seed() const;
    /// In the order of the source; none for a .lsb file.
    [[nodiscard]] const std::vector<Constant>& constants() const;
    /// The .lsys text of a grammar in another dialect; empty for others.
    [[nodiscard]] const std::string& translation() const;
    /// Bytes of a .lsb file.
    [[nodiscard]] std::string bytecode() const;
    /// Sizes of generations 0 to `generations`. Empty if they cannot be predicted, as with
    /// `#decompose` and `%`; shorter for very large programs.
    [[nodiscard]] std::vector<PredictedSize> predict(std::uint32_t generations) const;

    struct Data;
    explicit Grammar(std::shared_ptr<const Data> data) noexcept;
    [[nodiscard]] const Data& data() const { return *data_; }

private:
    std::shared_ptr<const Data> data_; // never null
};

/// Reads and compiles a file. Paths in it are relative to its folder.
[[nodiscard]] LSYS_API Outcome<Grammar> compile_file(const std::string& path,
                                                     const GrammarOptions& options = {},
                                                     const Project& project = {});
/// Compiles `text`. `name`: as messages show it; paths in the text are relative to its folder.
[[nodiscard]] LSYS_API Outcome<Grammar> compile_text(std::string text,
                                                     const std::string& name = "grammar.lsys",
                                                     const GrammarOptions& options = {},
                                                     const Project& project = {});

} // namespace lsys::LSYS_INTERFACE
