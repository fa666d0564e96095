// SPDX-License-Identifier: MIT
#include "runtime/languageserver/impl/workspace.h"

#include "grammar/ast/include_chain.h"
#include "grammar/base/cancellation.h"
#include "grammar/base/characters.h"
#include "grammar/base/paths.h"
#include "grammar/lsys/included_names.h"
#include "runtime/base/deadline.h"
#include "runtime/base/size_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace lsys {

namespace {

constexpr std::string_view kFileScheme = "file://";
constexpr std::string_view kMark = "\xEF\xBB\xBF";
/// Max size of a file that is not open.
constexpr std::uint64_t kMaxProjectBytes = std::uint64_t{1} << 20U;
constexpr std::size_t kMaxRootFiles = 64;

int hex_digit(char c) {
    if (is_digit(c)) {
        return c - '0';
    }
    const char lower = static_cast<char>(c | 0x20);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

bool has_drive(std::string_view path) {
    return path.size() > 2 && path[0] == '/' && is_letter(path[1]) && path[2] == ':';
}

} // namespace

std::vector<std::string> included_files(const std::string& path, std::string_view text) {
    std::vector<std::string> files;
    for (const std::string_view name : included_names(text)) {
        files.push_back(normalised_path(path_beside(path, name)));
    }
    return files;
}

std::string path_of_uri(std::string_view uri) {
    if (!uri.starts_with(kFileScheme)) {
        return std::string(uri);
    }
    std::string_view encoded = uri.substr(kFileScheme.size());
    encoded.remove_prefix(std::min(encoded.find('/'), encoded.size())); // the host
    std::string path;
    for (std::size_t i = 0; i < encoded.size(); ++i) {
        const int high =
            encoded[i] == '%' && i + 2 < encoded.size() ? hex_digit(encoded[i + 1]) : -1;
        const int low = high >= 0 ? hex_digit(encoded[i + 2]) : -1;
        if (low >= 0) {
            path += static_cast<char>(high * 16 + low);
            i += 2;
        } else {
            path += encoded[i];
        }
    }
    return normalised_path(has_drive(path) ? std::string_view(path).substr(1) : path);
}

std::string uri_of_path(std::string_view path) {
    constexpr std::string_view kHex = "0123456789ABCDEF";
    std::string uri(kFileScheme);
    uri += path.starts_with('/') ? "" : "/";
    for (const char c : path) {
        if (is_word_character(c) || std::string_view("/-.~").find(c) != std::string_view::npos) {
            uri += c;
        } else {
            const auto byte = static_cast<unsigned char>(c);
            uri += '%';
            uri += kHex[byte >> 4U];
            uri += kHex[byte & 15U];
        }
    }
    return uri;
}

std::string Workspace::uri_of(const std::string& path) const {
    const auto open = documents.find(path);
    return open != documents.end() ? open->second.uri : uri_of_path(path);
}

Workspace::Workspace(LanguageServerHost own_host) : host(std::move(own_host)) {
    Host& files = host.project.host;
    const auto open_first = [this](auto read) {
        return [this, read](const std::string& path, const ReadLimit& limit) {
            const auto open = documents.find(normalised_path(path));
            return open != documents.end() ? Result<std::string>(open->second.text)
                                           : read(path, limit);
        };
    };
    files.read_file = open_first(files.read_referenced_file);
    files.read_referenced_file = open_first(files.read_referenced_file);
    files.file_exists = [this, exists = files.file_exists](const std::string& path) {
        return documents.contains(normalised_path(path)) || exists(path);
    };
}

Document& Workspace::document(const Json& uri) {
    const auto found = documents.find(path_of_uri(uri.get<std::string>()));
    if (found == documents.end()) {
        throw RequestError(RpcError::InvalidParams,
                           "the document is not open: " + uri.get<std::string>());
    }
    return found->second;
}

std::optional<std::string> Workspace::text_of(const std::string& path) const {
    Result<std::string> read =
        host.project.host.read_referenced_file(path, {kMaxSourceBytes, kMaxProjectBytes << 6U});
    if (!read) {
        return std::nullopt;
    }
    std::string& text = read.value();
    if (text.starts_with(kMark)) {
        text.erase(0, kMark.size());
    }
    return std::move(text);
}

std::vector<std::string> Workspace::known_grammars(const std::string& path) const {
    std::set<std::string> known;
    for (const auto& [open, document] : documents) {
        if (document.has_lsys_text()) {
            known.insert(open);
        }
    }
    const auto add_folder = [&](const std::string& folder) {
        for (const std::string& file : host.grammars_below(folder)) {
            known.insert(normalised_path(file));
        }
    };
    for (const std::string& folder : folders) {
        add_folder(folder);
    }
    if (folders.empty() && is_absolute_path(path)) {
        add_folder(std::string(folder_of_path(path)));
    }
    return {known.begin(), known.end()};
}

std::vector<std::string> Workspace::roots_of(const std::string& path) const {
    std::map<std::string, std::vector<std::string>> including; // by included file
    for (const std::string& file : known_grammars(path)) {
        const Result<std::string> text =
            host.project.host.read_referenced_file(file, {kMaxSourceBytes, kMaxProjectBytes});
        for (const std::string& included :
             included_files(file, text ? std::string_view(text.value()) : "")) {
            including[included].push_back(file);
        }
    }
    std::set<std::string> reached{path};
    std::vector<std::string> left{path};
    std::set<std::string> roots;
    while (!left.empty()) {
        const std::string file = std::move(left.back());
        left.pop_back();
        const auto found = including.find(file);
        if (found == including.end()) {
            roots.insert(file);
            continue;
        }
        for (const std::string& next : found->second) {
            if (reached.insert(next).second) {
                left.push_back(next);
            }
        }
    }
    if (roots.empty()) {
        roots.insert(path); // the files include each other
    }
    std::vector<std::string> found(roots.begin(), roots.end());
    found.resize(std::min(found.size(), kMaxRootFiles));
    return found;
}

FileLoader Workspace::loader() const {
    return make_loader(host.project, host.project.limits.max_bytes);
}

bool Workspace::is_lsys_text(const std::string& path) const {
    const auto open = documents.find(path);
    return open != documents.end() ? open->second.has_lsys_text() : path.ends_with(".lsys");
}

std::shared_ptr<const IndexedGrammar> Workspace::parse(const std::string& root,
                                                       const FileLoader& load) const {
    auto grammar = std::make_shared<IndexedGrammar>();
    const FileLoader record = [&](const std::string& path) {
        Result<std::string> text = load(path);
        grammar->texts.insert_or_assign(path, text ? std::optional(text.value())
                                                   : std::optional<std::string>());
        return text;
    };
    const Result<std::string> text = record(root);
    if (!text || text.value().size() > host.max_document_bytes) {
        return nullptr;
    }
    grammar->is_lsys = is_lsys_text(root);
    const Dialect dialect =
        grammar->is_lsys ? Dialect::Lsys
                         : detect_dialect(root, text.value()).dialect.value_or(Dialect::Lsys);
    parse_grammar(root, text.value(), dialect, record, grammar->parsed);
    grammar->index = index_names(grammar->parsed);
    return grammar;
}

std::shared_ptr<const IndexedGrammar> Workspace::grammar(const std::string& root) {
    constexpr std::size_t kMaxGrammars = 32;
    const FileLoader load = loader();
    const auto is_current = [&](const IndexedGrammar& grammar) {
        const auto is_same = [&](const auto& read) {
            const Result<std::string> text = load(read.first);
            return text ? read.second == text.value() : !read.second;
        };
        return grammar.is_lsys == is_lsys_text(root) &&
               std::all_of(grammar.texts.begin(), grammar.texts.end(), is_same);
    };
    const auto found = std::find_if(grammars_.begin(), grammars_.end(),
                                    [&](const auto& one) { return one.first == root; });
    std::shared_ptr<const IndexedGrammar> grammar;
    if (found != grammars_.end()) {
        grammar = is_current(*found->second) ? found->second : nullptr;
        grammars_.erase(found);
    }
    if (!grammar) {
        grammar = parse(root, loader());
    }
    if (grammar) {
        if (grammars_.size() == kMaxGrammars) {
            grammars_.erase(grammars_.begin());
        }
        grammars_.emplace_back(root, grammar);
    }
    return grammar;
}

std::shared_ptr<const NameIndex> Workspace::names(const std::vector<std::string>& roots) {
    if (roots.size() == 1) {
        if (const std::shared_ptr<const IndexedGrammar> one = grammar(roots.front())) {
            return {one, &one->index};
        }
    }
    auto all = std::make_shared<NameIndex>();
    for (const std::string& root : roots) {
        if (const std::shared_ptr<const IndexedGrammar> one = grammar(root)) {
            all->profile = one->index.profile;
            all->merge(one->index);
        }
    }
    return all;
}

NameIndex Workspace::names_if(const std::vector<std::string>& roots,
                              const std::map<std::string, std::string>& changed) const {
    const FileLoader disk = loader();
    const FileLoader load = [&](const std::string& path) {
        const auto found = changed.find(normalised_path(path));
        return found != changed.end() ? Result<std::string>(found->second) : disk(path);
    };
    NameIndex all;
    for (const std::string& root : roots) {
        if (const std::shared_ptr<const IndexedGrammar> one = parse(root, load)) {
            all.profile = one->index.profile;
            all.merge(one->index);
        }
    }
    return all;
}

GrammarText Workspace::grammar_text(const Document& document, std::string& failure) const {
    GrammarText text;
    Outcome<GrammarText> read = read_grammar(
        document.path, document.is_lsys ? std::string("lsys") : std::string(), host.project);
    if (read) {
        text = std::move(read.value());
        if (text.bytes.size() > host.max_document_bytes) {
            failure = fmt::format("a grammar of more than {} is not checked while it is edited; "
                                  "`lsc check` checks it",
                                  byte_size_text(host.max_document_bytes));
        }
        return text;
    }
    for (const Message& message : read.messages().all()) {
        failure += message.kind == Message::Kind::Error ? message.text : "";
    }
    return text;
}

GrammarOptions Workspace::options_of(const Document& document) const {
    GrammarOptions options;
    if (document.has_lsys_text() && document.text.find("#w") == std::string::npos) {
        const std::vector<std::string> roots = roots_of(document.path);
        options.part = roots.size() > 1 || roots.front() != document.path;
    }
    return options;
}

std::string too_slow_message(double seconds) {
    return fmt::format("this takes longer than {:g} s, the limit of the language server", seconds);
}

void Workspace::compile(const GrammarOptions& options, CheckedDocument& checked) const {
    const Deadline deadline(host.max_seconds, host.project.host.cancelled, {});
    const CancellationScope scope(deadline.stop());
    try {
        Result<CompiledText> compiled = compile_text(checked.path, checked.text, options,
                                                     host.project.limits.max_modules, loader());
        if (compiled) {
            checked.compiled = std::move(compiled.value());
        } else {
            checked.failure = compiled.error().message;
        }
    } catch (const CompilationCancelled&) {
        if (!deadline.has_passed()) {
            throw; // the program ends
        }
        checked.failure = too_slow_message(host.max_seconds);
    }
}

CheckedDocument Workspace::check_anew(const Document& document) const {
    CheckedDocument checked;
    checked.path = document.path;
    checked.text = grammar_text(document, checked.failure);
    if (!checked.failure.empty()) {
        return checked;
    }
    compile(options_of(document), checked);
    return checked;
}

const CheckedDocument& Workspace::check(Document& document) {
    if (!document.checked) {
        CheckedDocument checked = check_anew(document);
        checked.compiled.diagnostics.sort_by_place();
        const SourceMap& sources = *checked.compiled.grammar.sources;
        document.inputs.clear();
        for (std::uint32_t i = 0; i < sources.file_count(); ++i) {
            document.inputs.insert(normalised_path(sources.file(static_cast<FileId>(i)).path()));
        }
        document.checked = std::make_shared<const CheckedDocument>(std::move(checked));
    }
    return *document.checked;
}

CheckedDocument Workspace::check_with_offers(Document& document) {
    CheckedDocument checked = check_anew(document);
    if (checked.failure.empty() && host.offer_doubtful) {
        host.offer_doubtful({document.path, checked.text, options_of(document)}, host.project,
                            checked.compiled);
    }
    checked.compiled.diagnostics.sort_by_place();
    return checked;
}

CheckedDocument Workspace::check_whole(const Document& document,
                                       const GrammarOptions& options) const {
    Document whole;
    whole.path = options_of(document).part ? roots_of(document.path).front() : document.path;
    whole.is_lsys = document.is_lsys;
    CheckedDocument checked;
    checked.path = whole.path;
    checked.text = grammar_text(whole, checked.failure);
    if (!checked.failure.empty()) {
        return checked;
    }
    compile(options, checked);
    checked.compiled.diagnostics.sort_by_place();
    return checked;
}

std::map<std::string, std::string> Workspace::fixed(Document& document) {
    std::string failure;
    const GrammarText text = grammar_text(document, failure);
    if (!failure.empty() || !host.fix) {
        return {};
    }
    return host.fix({document.path, text, options_of(document)}, host.project);
}

Places::File& Places::file(const std::string& path) {
    const auto [found, is_new] = files_.try_emplace(path);
    File& file = found->second;
    if (is_new) {
        const auto open = workspace_.documents.find(path);
        if (open != workspace_.documents.end()) {
            file.text = open->second.text;
        } else {
            file.text = workspace_.text_of(path).value_or(std::string());
        }
        file.mark = file.text.starts_with(kMark) ? kMark.size() : 0;
        file.unmarked = file.text.substr(file.mark);
        file.positions.emplace(file.text, workspace_.editor.encoding);
    }
    return file;
}

const std::string& Places::text(const std::string& path) {
    return file(path).unmarked;
}

TextPosition Places::position(const std::string& path, std::uint32_t offset) {
    const File& in = file(path);
    return in.positions->position(offset + in.mark);
}

Json Places::range(const TextPlace& place) {
    const auto json = [&](std::uint32_t offset) {
        const TextPosition found = position(place.path, offset);
        return Json{{"line", found.line}, {"character", found.character}};
    };
    return {{"start", json(place.begin)}, {"end", json(place.end)}};
}

Json Places::location(const TextPlace& place) {
    return {{"uri", workspace_.uri_of(place.path)}, {"range", range(place)}};
}

TextPosition position_of(const Json& position) {
    const auto number = [&](const char* name) {
        const Json& value = position.at(name);
        if (!value.is_number_unsigned()) {
            throw RequestError(RpcError::InvalidParams,
                               std::string("`") + name + "` is no whole number from 0");
        }
        // The largest number that the specification of LSP allows.
        constexpr std::uint64_t kMax = 0x7FFFFFFF;
        return static_cast<std::uint32_t>(std::min(value.get<std::uint64_t>(), kMax));
    };
    return {number("line"), number("character")};
}

std::uint32_t Places::offset(const std::string& path, const Json& position) {
    const File& in = file(path);
    const std::size_t found = in.positions->offset(position_of(position));
    return static_cast<std::uint32_t>(std::max(found, in.mark) - in.mark);
}

Json changing_edit(const std::string& path,
                   std::string_view before,
                   std::string_view after,
                   Places& at) {
    const auto is_inside = [](std::string_view text, std::size_t offset) {
        return offset < text.size() && (static_cast<unsigned char>(text[offset]) & 0xC0U) == 0x80U;
    };
    const std::size_t shorter = std::min(before.size(), after.size());
    auto same = static_cast<std::size_t>(
        std::mismatch(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(shorter),
                      after.begin())
            .first -
        before.begin());
    while (same > 0 && (is_inside(before, same) || is_inside(after, same))) {
        --same;
    }
    std::size_t tail = 0;
    while (tail < shorter - same &&
           before[before.size() - 1 - tail] == after[after.size() - 1 - tail]) {
        ++tail;
    }
    while (tail > 0 && is_inside(before, before.size() - tail)) {
        --tail;
    }
    // A `\r\n` is one line end: no place lies within it.
    if (same > 0 && before[same - 1] == '\r') {
        --same;
    }
    if (tail > 0 && before[before.size() - tail] == '\n' && before.size() > tail) {
        --tail;
    }
    return {{"range", at.range({path, static_cast<std::uint32_t>(same),
                                static_cast<std::uint32_t>(before.size() - tail)})},
            {"newText", std::string(after.substr(same, after.size() - tail - same))}};
}

} // namespace lsys
