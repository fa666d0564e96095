// SPDX-License-Identifier: MIT
/* liblsys for C, and for languages that call C: L-systems compiled, derived, drawn and meshed.
 *
 *   - Values are handles. The caller owns each handle that a call returns, and frees it once with
 *     lsys_..._free(). Several threads may use a handle at once.
 *   - A call that may fail returns a status. `messages`, if not null, receives the messages of the
 *     call, even if it succeeds; free them with lsys_messages_free().
 *   - Texts are UTF-8 and end with a zero byte. Texts and arrays that a handle returns belong to
 *     the handle and are valid until it is freed.
 *   - Metres, kilograms, right-handed axes, +Y up. */
#ifndef LSYS_H
#define LSYS_H

/* NOLINTBEGIN(readability-identifier-naming): names as in C */

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(LSYS_SHARED)
#ifdef LSYS_BUILDS_LIBRARY
#define LSYS_C_API __declspec(dllexport)
#else
#define LSYS_C_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define LSYS_C_API __attribute__((visibility("default")))
#else
#define LSYS_C_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef enum lsys_status {
    LSYS_OK = 0,
    LSYS_DIAGNOSED = 1,     /* mistakes in the grammar */
    LSYS_FAILED = 2,        /* a file cannot be read, an option does not fit */
    LSYS_LIMIT = 3,         /* max_modules or another limit is exceeded */
    LSYS_OUT_OF_MEMORY = 4, /* a failed allocation */
    LSYS_CANCELLED = 5      /* a function of the caller ended the call */
} lsys_status;

typedef struct lsys_grammar lsys_grammar;
typedef struct lsys_word lsys_word;
typedef struct lsys_plant lsys_plant;
typedef struct lsys_mesh lsys_mesh;
typedef struct lsys_forest lsys_forest;
typedef struct lsys_instances lsys_instances;
typedef struct lsys_messages lsys_messages;

/* Where the turtle stands at a module `?NAME`: metres and unit vectors, in the plant's own axes. */
typedef struct lsys_sense_place {
    double position[3];
    double heading[3];
    double up[3];
} lsys_sense_place;

/* All modules `?NAME` of one word, in word order. Arrays are valid during the call. */
typedef struct lsys_environment_query {
    uint32_t generation; /* age of the word */
    size_t place_count;  /* at least 1 */
    const lsys_sense_place* places;
    const float* parameters; /* of the modules, one after the other */
    const uint32_t* offsets; /* place_count + 1 indexes: first parameter of each module, the end */
} lsys_environment_query;

/* Answers an environment that `#sense NAME program;` declares, in place of a program. */
typedef struct lsys_environment {
    const char* name; /* NAME, without the `?` */
    /* Returns 0 and sets `size`, the count of numbers for each place, and `numbers`, place_count *
     * size numbers, which must stay valid until the next call of the function or the end of the
     * library call. Returns another number, which the message shows, if there is no answer. */
    int (*answer)(void* user,
                  const lsys_environment_query* query,
                  const double** numbers,
                  size_t* size);
    void* user; /* first argument of `answer` */
} lsys_environment;

/* Input that all calls share. Initialise with LSYS_PROJECT_DEFAULTS. The functions get `user` as
 * their first argument; they are called from any thread, but never from two at once. */
typedef struct lsys_project {
    uint32_t threads;     /* 0: as many as the machine has */
    uint64_t max_modules; /* of a word; 0: 2^32 */
    uint64_t max_bytes;   /* of a word, skeleton, mesh and file; 0: half of the memory */
    /* Reads a file; null: files are read from disk. Returns 0 and sets `bytes` and `size`, which
     * must stay valid until the next call of read_file or the end of the library call; not 0: no
     * file. */
    int (*read_file)(void* user, const char* path, const char** bytes, size_t* size);
    /* Returns 0 to continue, another number to end the call with LSYS_CANCELLED; may be null. */
    int (*progress)(void* user, uint32_t generation, uint32_t generations, uint64_t modules);
    void* user;
    const lsys_environment* environments; /* may be null */
    size_t environment_count;
    /* Not 0: grammars and scenes are not trusted. They name only files in `root` or below; limits
     * that are 0 become 1 GiB for max_bytes and max_output, and 60 for max_seconds. */
    int untrusted;
    const char* root;    /* null: the folder of the grammar or scene, no folder for a text */
    double max_seconds;  /* of each call; 0: no limit */
    uint64_t max_output; /* bytes of the files of a call; 0: no limit */
} lsys_project;
#define LSYS_PROJECT_DEFAULTS                                                                      \
    { 0, 0, 0, NULL, NULL, NULL, NULL, 0, 0, NULL, 0.0, 0 }

/* The version of the linked library: "0.1.0". */
LSYS_C_API const char* lsys_version(void);
/* The text of a status. */
LSYS_C_API const char* lsys_status_text(lsys_status status);

/* --- messages --------------------------------------------------------------------------------- */

typedef enum lsys_severity { LSYS_NOTE = 0, LSYS_WARNING = 1, LSYS_ERROR = 2 } lsys_severity;

/* One message. A message without a place has line 0. Lines and columns count from 1; a column is a
 * Unicode code point; the end is exclusive. */
typedef struct lsys_message {
    lsys_severity severity;
    const char* code; /* stable name, "unknown-name"; empty for messages about files and options */
    const char* text;
    const char* file;
    uint32_t line, column, end_line, end_column;
} lsys_message;

LSYS_C_API size_t lsys_messages_count(const lsys_messages* messages);
/* Precondition: index < lsys_messages_count(). */
LSYS_C_API lsys_message lsys_messages_get(const lsys_messages* messages, size_t index);
/* All messages, with the lines of the source and carets. */
LSYS_C_API const char* lsys_messages_text(const lsys_messages* messages);
LSYS_C_API void lsys_messages_free(lsys_messages* messages); /* null is allowed */

/* --- grammars --------------------------------------------------------------------------------- */

/* The value of a constant, and the values of a setting as in `#set`. */
typedef struct lsys_definition {
    const char* name;
    float value;
} lsys_definition;
typedef struct lsys_setting {
    const char* key;
    const char* values; /* as after the key in `#set`: "0 -1 0" */
} lsys_setting;

/* Initialise with LSYS_GRAMMAR_DEFAULTS. */
typedef struct lsys_grammar_options {
    const char* dialect; /* "lsys", "cpfg" ...; null: detected */
    const char* system;  /* name in a file with several systems; null: the only system */
    const lsys_definition* definitions;
    size_t definition_count;
    const lsys_setting* settings;
    size_t setting_count;
    int32_t generations; /* replaces `#n`; negative: the value of the grammar */
} lsys_grammar_options;
#define LSYS_GRAMMAR_DEFAULTS                                                                      \
    { NULL, NULL, NULL, 0, NULL, 0, -1 }

/* `options` and `project` may be null: defaults. `*grammar` is null if the call fails. */
LSYS_C_API lsys_status lsys_compile_file(const char* path,
                                         const lsys_grammar_options* options,
                                         const lsys_project* project,
                                         lsys_grammar** grammar,
                                         lsys_messages** messages);
/* `name`: file name in messages; null: "grammar.lsys". */
LSYS_C_API lsys_status lsys_compile_text(const char* text,
                                         size_t size,
                                         const char* name,
                                         const lsys_grammar_options* options,
                                         const lsys_project* project,
                                         lsys_grammar** grammar,
                                         lsys_messages** messages);
/* The value of lsys_grammar_options::generations, else of `#n`; negative: none. */
LSYS_C_API int64_t lsys_grammar_generations(const lsys_grammar* grammar);
LSYS_C_API uint64_t lsys_grammar_seed(const lsys_grammar* grammar);
LSYS_C_API void lsys_grammar_free(lsys_grammar* grammar); /* null is allowed */

/* --- words ------------------------------------------------------------------------------------ */

/* `generations` negative or `seed` null: the value of the grammar. */
LSYS_C_API lsys_status lsys_derive(const lsys_grammar* grammar,
                                   int64_t generations,
                                   const uint64_t* seed,
                                   const lsys_project* project,
                                   lsys_word** word,
                                   lsys_messages** messages);
LSYS_C_API uint64_t lsys_word_size(const lsys_word* word); /* number of modules */
/* The codes of all modules, unsigned integers of lsys_word_code_bytes() bytes: 1, 2 or 4. */
LSYS_C_API const void* lsys_word_codes(const lsys_word* word);
LSYS_C_API uint32_t lsys_word_code_bytes(const lsys_word* word);
/* The stored parameters of all modules, in order. */
LSYS_C_API const float* lsys_word_parameters(const lsys_word* word);
LSYS_C_API uint64_t lsys_word_parameter_count(const lsys_word* word);

/* The meaning of a code. Each module of the code stores `stored_parameters` parameters; if this is
 * 0, all have the parameters `constants`. */
typedef struct lsys_module_kind {
    const char* name;
    uint32_t stored_parameters;
    const float* constants;
    size_t constant_count;
} lsys_module_kind;
LSYS_C_API uint32_t lsys_word_kind_count(const lsys_word* word);
/* Precondition: code < lsys_word_kind_count(). */
LSYS_C_API lsys_module_kind lsys_word_kind(const lsys_word* word, uint32_t code);
/* Calls `write` with the text of the word in pieces, until it returns a number other than 0.
 * Returns LSYS_OK or LSYS_CANCELLED. */
LSYS_C_API lsys_status lsys_word_text(const lsys_word* word,
                                      int (*write)(void* user, const char* piece, size_t size),
                                      void* user);
LSYS_C_API void lsys_word_free(lsys_word* word); /* null is allowed */

/* --- plants and meshes ------------------------------------------------------------------------ */

#define LSYS_NO_PARENT 0xFFFFFFFFu

/* A straight piece of a stem, from `base` by `length` along +Y of its frame, a unit quaternion
 * x, y, z, w. 60 bytes. */
typedef struct lsys_segment {
    float base[3];
    float length;
    float frame[4];
    float base_radius, tip_radius;
    float spring;    /* N m / rad, of the joint at the base */
    float mass;      /* kg */
    uint32_t parent; /* earlier in the array, or LSYS_NO_PARENT */
    uint32_t colour; /* index of the palette, or 0x1000000 + red * 65536 + green * 256 + blue */
    uint16_t order;  /* number of open brackets: 0 is the trunk */
    uint8_t sides;   /* corners of its cross-section; 0: the grammar does not set them */
    uint8_t flags;   /* bit 0: begins where its parent ends */
} lsys_segment;

LSYS_C_API lsys_status lsys_grow(const lsys_grammar* grammar,
                                 int64_t generations,
                                 const uint64_t* seed,
                                 const lsys_project* project,
                                 lsys_plant** plant,
                                 lsys_messages** messages);
LSYS_C_API const lsys_segment* lsys_plant_segments(const lsys_plant* plant);
LSYS_C_API size_t lsys_plant_segment_count(const lsys_plant* plant);
LSYS_C_API void lsys_plant_free(lsys_plant* plant); /* null is allowed */

/* `sides`: of cross-sections; 0: the values of the grammar. */
LSYS_C_API lsys_status lsys_make_mesh(const lsys_plant* plant,
                                      uint32_t sides,
                                      const lsys_project* project,
                                      lsys_mesh** mesh,
                                      lsys_messages** messages);
LSYS_C_API uint64_t lsys_mesh_vertex_count(const lsys_mesh* mesh);
LSYS_C_API uint64_t lsys_mesh_index_count(const lsys_mesh* mesh); /* three for each triangle */
/* Three floats for each vertex. */
LSYS_C_API const float* lsys_mesh_positions(const lsys_mesh* mesh);
LSYS_C_API const float* lsys_mesh_normals(const lsys_mesh* mesh);
/* Two floats for each vertex; v goes down. */
LSYS_C_API const float* lsys_mesh_texture_coordinates(const lsys_mesh* mesh);
/* Writes `count` indices from `first` on. Precondition: first + count <= index count. */
LSYS_C_API void
lsys_mesh_read_indices(const lsys_mesh* mesh, uint64_t first, uint64_t count, uint32_t* to);

/* Triangles of one material: `index_count` indices from `first_index` on. */
typedef struct lsys_mesh_part {
    uint64_t first_index, index_count;
    const char* material; /* its name */
    float colour[4];      /* linear red, green, blue, opacity */
    float roughness;      /* 0 to 1 */
    int two_sided;        /* 0 or 1 */
} lsys_mesh_part;
LSYS_C_API size_t lsys_mesh_part_count(const lsys_mesh* mesh);
/* Precondition: index < lsys_mesh_part_count(). */
LSYS_C_API lsys_mesh_part lsys_mesh_get_part(const lsys_mesh* mesh, size_t index);
/* Calls `write` with a file ("glb", "obj" ...) in pieces until it returns a number other than 0. */
LSYS_C_API lsys_status lsys_export(const lsys_plant* plant,
                                   const lsys_mesh* mesh,
                                   const char* format,
                                   int (*write)(void* user, const char* piece, size_t size),
                                   void* user,
                                   const lsys_project* project,
                                   lsys_messages** messages);
LSYS_C_API void lsys_mesh_free(lsys_mesh* mesh); /* null is allowed */

/* --- files ------------------------------------------------------------------------------------ */

/* An option of `lsc export` or `lsc forest` by name without dashes, and its value; an empty value
 * for a flag: {"preset", "unreal"}, {"wind-data", ""}. */
typedef struct lsys_option {
    const char* name;
    const char* value;
} lsys_option;

/* Takes a piece of the file `name`. Files come one after the other; the last piece of each is
 * empty, with `is_last` 1. Returns 0 to continue, another number to end the call with
 * LSYS_CANCELLED. */
typedef int (*lsys_receive)(
    void* user, const char* name, const char* bytes, size_t size, int is_last);

/* Writes `path` and the files beside it: pictures, levels of detail, frames. All appear or none. */
LSYS_C_API lsys_status lsys_save_plant(const lsys_plant* plant,
                                       const char* path,
                                       const lsys_option* options,
                                       size_t option_count,
                                       const lsys_project* project,
                                       lsys_messages** messages);
/* Like lsys_save_plant(), but passes the files to `receive`. */
LSYS_C_API lsys_status lsys_write_plant(const lsys_plant* plant,
                                        const char* name,
                                        const lsys_option* options,
                                        size_t option_count,
                                        lsys_receive receive,
                                        void* user,
                                        const lsys_project* project,
                                        lsys_messages** messages);

/* --- forests ---------------------------------------------------------------------------------- */

/* A tree of a forest. 28 bytes. */
typedef struct lsys_tree {
    float position[3]; /* m, of the start of the turtle */
    float yaw;         /* radians about +Y */
    float scale;
    uint32_t number;  /* determines the branches of the tree */
    uint16_t species; /* index of the species in the scene, or of its grammar */
    uint16_t age;     /* years; 0: the last stage of its species */
} lsys_tree;

/* Grows the forest of a scene (.toml) or of grammars. `grammar_options` hold for all species;
 * `options` replace values of the scene: {"count", "500"}, {"rho", "0"}. */
LSYS_C_API lsys_status lsys_grow_forest(const char* const* files,
                                        size_t file_count,
                                        const lsys_grammar_options* grammar_options,
                                        const lsys_option* options,
                                        size_t option_count,
                                        const lsys_project* project,
                                        lsys_forest** forest,
                                        lsys_messages** messages);
/* Grows trees at places; their species are indices of `grammars`. */
LSYS_C_API lsys_status lsys_forest_of_places(const char* const* grammars,
                                             size_t grammar_count,
                                             const lsys_tree* places,
                                             size_t place_count,
                                             const lsys_grammar_options* grammar_options,
                                             const lsys_option* options,
                                             size_t option_count,
                                             const lsys_project* project,
                                             lsys_forest** forest,
                                             lsys_messages** messages);
LSYS_C_API const lsys_tree* lsys_forest_trees(const lsys_forest* forest);
LSYS_C_API size_t lsys_forest_tree_count(const lsys_forest* forest);
/* Like lsys_save_plant() and lsys_write_plant(), with options of `lsc forest`. */
LSYS_C_API lsys_status lsys_save_forest(const lsys_forest* forest,
                                        const char* path,
                                        const lsys_option* options,
                                        size_t option_count,
                                        const lsys_project* project,
                                        lsys_messages** messages);
LSYS_C_API lsys_status lsys_write_forest(const lsys_forest* forest,
                                         const char* name,
                                         const lsys_option* options,
                                         size_t option_count,
                                         lsys_receive receive,
                                         void* user,
                                         const lsys_project* project,
                                         lsys_messages** messages);
LSYS_C_API void lsys_forest_free(lsys_forest* forest); /* null is allowed */

/* An instance: its mesh is scaled, then turned by a unit quaternion x, y, z, w, then moved. 40
 * bytes. */
typedef struct lsys_instance {
    float position[3];
    float scale;
    float rotation[4];
    uint32_t tree;  /* index in lsys_forest_trees() */
    uint32_t group; /* index in lsys_instances_groups() */
} lsys_instance;
/* A draw call: instances of some parts of a mesh. */
typedef struct lsys_instance_group {
    uint32_t mesh;       /* below lsys_instances_mesh_count() */
    uint32_t first_part; /* of the mesh */
    uint32_t part_count;
    uint64_t first_instance;
    uint64_t instance_count;
} lsys_instance_group;

/* Expands all trees and meshes their branches. `sides`: of cross-sections; 0: the values of the
 * grammar. */
LSYS_C_API lsys_status lsys_make_instances(const lsys_forest* forest,
                                           uint32_t sides,
                                           const lsys_project* project,
                                           lsys_instances** instances,
                                           lsys_messages** messages);
LSYS_C_API const lsys_instance* lsys_instances_all(const lsys_instances* instances);
LSYS_C_API uint64_t lsys_instances_count(const lsys_instances* instances);
LSYS_C_API const lsys_instance_group* lsys_instances_groups(const lsys_instances* instances);
LSYS_C_API size_t lsys_instances_group_count(const lsys_instances* instances);
LSYS_C_API size_t lsys_instances_mesh_count(const lsys_instances* instances);
/* Returns a new handle, which the caller frees; null if memory runs out. Precondition: index <
 * lsys_instances_mesh_count(). */
LSYS_C_API lsys_mesh* lsys_instances_mesh(const lsys_instances* instances, size_t index);
/* Writes `count` instances from `first` on as matrices of 16 floats, column by column, `stride`
 * bytes apart; 0: 64. Precondition: first + count <= lsys_instances_count(). */
LSYS_C_API void lsys_instances_read_matrices(
    const lsys_instances* instances, uint64_t first, uint64_t count, void* to, size_t stride);
LSYS_C_API void lsys_instances_free(lsys_instances* instances); /* null is allowed */

#ifdef __cplusplus
}
#endif

/* NOLINTEND(readability-identifier-naming) */

#endif
