// SPDX-License-Identifier: MIT
/* The C interface: derives a word and lists its modules; then counts the triangles of its plant.
 * Usage: list_modules FILE */
#include <lsys.h>
#include <stdio.h>

int main(int count, char** arguments) {
    if (count != 2) {
        fputs("usage: list_modules FILE\n", stderr);
        return 2;
    }
    lsys_grammar* grammar = NULL;
    lsys_messages* messages = NULL;
    lsys_status status = lsys_compile_file(arguments[1], NULL, NULL, &grammar, &messages);
    fputs(lsys_messages_text(messages), stderr);
    lsys_messages_free(messages);
    if (status != LSYS_OK) {
        return (int)status;
    }
    lsys_word* word = NULL;
    status = lsys_derive(grammar, 1, NULL, NULL, &word, NULL);
    if (status == LSYS_OK && lsys_word_code_bytes(word) == 1) {
        const unsigned char* codes = (const unsigned char*)lsys_word_codes(word);
        const float* parameters = lsys_word_parameters(word);
        for (uint64_t i = 0; i < lsys_word_size(word); ++i) {
            const lsys_module_kind kind = lsys_word_kind(word, codes[i]);
            const float* values = kind.stored_parameters > 0 ? parameters : kind.constants;
            const size_t value_count =
                kind.stored_parameters > 0 ? kind.stored_parameters : kind.constant_count;
            printf("%s", kind.name);
            for (size_t k = 0; k < value_count; ++k) {
                printf(" %g", (double)values[k]);
            }
            putchar('\n');
            parameters += kind.stored_parameters;
        }
    }
    lsys_word_free(word);
    lsys_plant* plant = NULL;
    lsys_mesh* mesh = NULL;
    status = lsys_grow(grammar, -1, NULL, NULL, &plant, NULL);
    if (status == LSYS_OK) {
        status = lsys_make_mesh(plant, 0, NULL, &mesh, NULL);
    }
    if (status == LSYS_OK) {
        printf("%lu triangles\n", (unsigned long)(lsys_mesh_index_count(mesh) / 3));
    }
    lsys_mesh_free(mesh);
    lsys_plant_free(plant);
    lsys_grammar_free(grammar);
    return (int)status;
}
