#include "compiler/check/check.h"

namespace lsys {

namespace {

struct ListedCheck {
    Check check;
    bool needs_complete; // keeps quiet about a program with errors
};

// The order is that of the messages about one place.
constexpr ListedCheck kChecks[] = {
    {nullptr, true},
};

} // namespace

void run_checks(const CheckInput& input, Diagnostics& diagnostics) {
    for (const ListedCheck& listed : kChecks) {
        if (listed.check != nullptr && (input.program.complete || !listed.needs_complete)) {
            listed.check(input, diagnostics);
        }
    }
}

SourceSpan module_name_span(const CheckInput& input, const ProgramWord& word, std::size_t index) {
    const ProgramModule module = input.program.modules[index];
    const std::string_view text = input.sources.file(word.file).text();
    const std::string_view name = input.name(module.symbol);
    const bool quoted = module.begin < text.size() && text[module.begin] == '`';
    const auto length = static_cast<std::uint32_t>(name.size() + (quoted ? 2 : 0));
    return {word.file, module.begin, module.begin + length};
}

} // namespace lsys
