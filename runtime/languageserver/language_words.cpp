// SPDX-License-Identifier: MIT
#include "runtime/languageserver/language_words.h"

#include "compiler/bytecode/environment_keys.h"
#include "compiler/resolve/known_words.h"
#include "compiler/resolve/profiles.h"
#include "grammar/base/characters.h"
#include "grammar/lsys/statement_names.h"
#include "runtime/languageserver/impl/vocabulary.h"

#include <algorithm>

namespace lsys {

namespace {

/// Sorts the words that begin with a letter, and drops others and repetitions.
void tidy(std::vector<std::string>& words) {
    std::erase_if(words,
                  [](const std::string& word) { return word.empty() || !is_letter(word[0]); });
    std::sort(words.begin(), words.end());
    words.erase(std::unique(words.begin(), words.end()), words.end());
}

} // namespace

LanguageWords language_words() {
    LanguageWords words;
    for (const std::string_view name : statement_names()) {
        words.statements.emplace_back(name);
    }
    for (const std::string_view name : function_names()) {
        words.functions.emplace_back(name);
    }
    for (const SettingHelp& row : setting_helps()) {
        words.settings.push_back(row.name);
        words.values.insert(words.values.end(), row.values.begin(), row.values.end());
    }
    for (const std::string_view key : material_keys()) {
        words.material_keys.emplace_back(key);
    }
    for (const std::string_view key : sense_keys()) {
        words.sense_keys.emplace_back(key);
    }
    for (const std::string_view kind : environment_kind_names()) {
        words.sense_kinds.emplace_back(kind);
    }
    for (const std::string_view shape : space_shape_names()) {
        words.sense_kinds.emplace_back(shape);
    }
    for (const TurtleObject& object : turtle_objects()) {
        words.objects.emplace_back(object.name);
    }
    for (const TurtleCommand& command : turtle_commands(TurtleProfile::Lsys)) {
        words.commands.emplace_back(command.name);
    }
    for (std::vector<std::string>* const list :
         {&words.statements, &words.functions, &words.settings, &words.values, &words.material_keys,
          &words.sense_keys, &words.sense_kinds, &words.objects, &words.commands}) {
        tidy(*list);
    }
    return words;
}

} // namespace lsys
