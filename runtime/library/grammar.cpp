// SPDX-License-Identifier: MIT
#include "compiler/bytecode/module_file.h"
#include "compiler/growth/growth.h"
#include "grammar/base/exponentials.h"
#include "runtime/library/impl/call.h"
#include "runtime/library/impl/data.h"
#include "runtime/pipeline/portable_files.h"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace lsys::v0 {

namespace {

std::vector<Constant> constants_of(const ::lsys::Grammar& grammar) {
    std::vector<Constant> constants;
    if (!grammar.program) {
        return constants;
    }
    for (const ::lsys::Constant& constant : grammar.program->constants) {
        constants.push_back({std::string(grammar.names.text(constant.name)), constant.is_param,
                             constant.is_random, constant.is_random ? 0.0F : constant.value,
                             constant.is_param ? constant.minimum : 0.0F,
                             constant.is_param ? constant.maximum : 0.0F});
    }
    return constants;
}

Outcome<Grammar> compile(Call& call,
                         const std::string& name,
                         const std::string& file,
                         const GrammarOptions& options) {
    return call.run<Grammar>(
        [&] { return load_grammar(name, inner_grammar_options(options), call.project()); },
        [&](::lsys::Grammar grammar) {
            auto data = std::make_shared<Grammar::Data>();
            data->name = name;
            data->file = file;
            data->inputs = call.files();
            data->policy = call.policy();
            data->constants = constants_of(grammar);
            grammar.program.reset(); // the bytecode is complete
            if (options.generations) {
                grammar.bytecode.generations = options.generations;
            }
            data->grammar = std::move(grammar);
            return Grammar(std::move(data));
        });
}

double rounded(const Count& count) {
    return count.exceeds ? power_of_two(count.log2)
                         : std::ldexp(static_cast<double>(count.value.high), 64) +
                               static_cast<double>(count.value.low);
}

} // namespace

::lsys::GrammarOptions inner_grammar_options(const GrammarOptions& options) {
    ::lsys::GrammarOptions out;
    out.dialect = options.dialect;
    out.system = options.system;
    out.bug_compatible = options.bug_compatible;
    for (const auto& [name, value] : options.definitions) {
        out.definitions.push_back({name, value});
    }
    for (const auto& [key, values] : options.settings) {
        out.settings.push_back({key, values});
    }
    out.generations = options.generations;
    return out;
}

::lsys::Grammar copy_of(const ::lsys::Grammar& original) {
    ::lsys::Grammar copy;
    copy.sources = std::make_shared<SourceMap>(*original.sources);
    copy.bytecode = original.bytecode;
    copy.height_span = original.height_span;
    copy.object_spans = original.object_spans;
    copy.is_module_file = original.is_module_file;
    return copy;
}

Grammar::Grammar(std::shared_ptr<const Data> data) noexcept : data_(std::move(data)) {}

const std::string& Grammar::name() const {
    return data_->name;
}

std::optional<std::uint32_t> Grammar::generations() const {
    return data_->grammar.bytecode.generations;
}

std::uint64_t Grammar::seed() const {
    const Settings& settings = data_->grammar.bytecode.settings;
    return settings.has_seed ? settings.seed : 0;
}

const std::vector<Constant>& Grammar::constants() const {
    return data_->constants;
}

const std::string& Grammar::translation() const {
    return data_->grammar.translation;
}

std::string Grammar::bytecode() const {
    Bytecode bytecode = data_->grammar.bytecode;
    remove_machine_paths(bytecode);
    return write_module_file(bytecode);
}

std::vector<PredictedSize> Grammar::predict(std::uint32_t generations) const {
    std::vector<PredictedSize> sizes;
    const Bytecode& bytecode = data_->grammar.bytecode;
    if (!is_growth_known(bytecode)) {
        return sizes;
    }
    const GrowthPrediction growth = predict_growth(bytecode, generations);
    for (std::size_t i = 0; i < growth.low.size(); ++i) {
        const GenerationSize& low = growth.low[i];
        const GenerationSize& high = growth.high[i];
        constexpr std::uint64_t kMaxBytes = std::numeric_limits<std::uint64_t>::max();
        sizes.push_back({rounded(low.modules), rounded(high.modules), rounded(low.segments),
                         rounded(high.segments),
                         high.bytes.at_most(kMaxBytes) ? high.bytes.value.low : kMaxBytes});
    }
    return sizes;
}

Outcome<Grammar>
compile_file(const std::string& path, const GrammarOptions& options, const Project& project) {
    Call call(project, {path}, {});
    return compile(call, path, path, options);
}

Outcome<Grammar> compile_text(std::string text,
                              const std::string& name,
                              const GrammarOptions& options,
                              const Project& project) {
    Call call(project, {"-"}, {});
    call.project().host.read_file = [&, read = std::move(call.project().host.read_file)](
                                        const std::string& path, const ReadLimit& limit) {
        return path == name ? Result<std::string>(text) : read(path, limit);
    };
    return compile(call, name, "-", options);
}

} // namespace lsys::v0
