// SPDX-License-Identifier: MIT
// Word: a derived string of modules in packed form: a code for each module, and the stored binary32
// parameters of all modules, in order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <lsys/api.h>
#include <lsys/grammar.h>
#include <lsys/outcome.h>
#include <lsys/project.h>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::LSYS_INTERFACE {

struct DeriveOptions {
    std::optional<std::uint32_t> generations; // unset: Grammar::generations(), else 0
    std::optional<std::uint64_t> seed;        // unset: Grammar::seed()
};

/// The meaning of a code of a word. A code may include constant arguments, `constants`; its modules
/// then store no parameters.
struct ModuleKind {
    std::string name;                    // "F", "+", "leaf"
    std::uint32_t stored_parameters = 0; // number of items in Word::parameters() for each module
    std::vector<float> constants;        // parameters of each module, if none are stored
};

/// A module of a word. Valid as long as the word exists.
struct Module {
    std::string_view name;
    std::span<const float> parameters;
};

/// A derived word. Cheap to copy, immutable, safe to use from several threads at once.
class LSYS_API Word {
public:
    [[nodiscard]] std::uint64_t size() const; // number of modules
    [[nodiscard]] std::uint32_t generation() const;
    [[nodiscard]] std::uint64_t seed() const;

    /// The codes of all modules, unsigned integers of code_bytes() bytes (1, 2 or 4) each.
    [[nodiscard]] const void* codes() const;
    [[nodiscard]] std::uint32_t code_bytes() const;
    /// The stored parameters of all modules, in order.
    [[nodiscard]] std::span<const float> parameters() const;
    /// The kinds of modules, indexed by code.
    [[nodiscard]] const std::vector<ModuleKind>& kinds() const;

    /// Calls visit(module) for `count` modules from `first` on in order, until visit() returns
    /// false. Finding the first module takes time linear in `first`.
    void visit(std::uint64_t first,
               std::uint64_t count,
               const std::function<bool(const Module& module)>& visit) const;
    /// The text of the word, which parses again as an axiom of its grammar.
    [[nodiscard]] std::string text() const;
    /// Calls `write` with the text in pieces, until it returns false. Returns whether the whole
    /// text was written.
    bool write_text(const std::function<bool(std::string_view piece)>& write) const;

    struct Data;
    explicit Word(std::shared_ptr<const Data> data) noexcept;
    [[nodiscard]] const Data& data() const { return *data_; }

private:
    std::shared_ptr<const Data> data_; // never null
};

[[nodiscard]] LSYS_API Outcome<Word>
derive(const Grammar& grammar, const DeriveOptions& options = {}, const Project& project = {});

} // namespace lsys::LSYS_INTERFACE
