/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/shared_object.h"

#include <dlfcn.h>
#include <errno.h>
#include <link.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* The loader would say of a source file that its header is invalid. */
static mor_status check_kind(mor_context *context, const char *what, const char *path, const char *needs)
{
    char start[SELFMAG] = "";
    FILE *file = fopen(path, "rb");
    MOR_CHECK(context, file != NULL, MOR_ERROR_CONFIG, "%s '%s' cannot be read: %s", what, path, strerror(errno));
    const size_t n_read = fread(start, 1, sizeof start, file);
    fclose(file);
    MOR_CHECK(context, n_read == sizeof start && memcmp(start, ELFMAG, SELFMAG) == 0, MOR_ERROR_CONFIG,
              "%s '%s' is no shared library, but a file of another kind; it must be %s", what, path, needs);
    return MOR_OK;
}

mor_status mor_shared_object_open(mor_context *context, const char *what, const char *path, const char *needs,
                                  void **object)
{
    *object = NULL;
    MOR_TRY(context, check_kind(context, what, path, needs));
    *object = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (*object == NULL) {
        const char *reason = dlerror();
        return MOR_FAIL(context, MOR_ERROR_PLUGIN, "%s '%s' cannot be loaded: %s; it must be %s", what, path,
                        reason != NULL ? reason : "no reason given", needs);
    }
    return MOR_OK;
}

mor_shared_function mor_shared_object_find(void *object, const char *name)
{
    void *symbol = dlsym(object, name);
    /* ISO C has no conversion from an object pointer to a function pointer; POSIX promises that the bytes agree. */
    mor_shared_function function = NULL;
    memcpy(&function, &symbol, sizeof function);
    return function;
}

/* The tables of a loaded object. */
typedef struct symbol_tables {
    const ElfW(Sym) * symbols;
    const char *names;
    const uint32_t *hash;     /* number of buckets, then number of symbols, ... */
    const uint32_t *gnu_hash; /* number of buckets, then number of symbols before those that are defined, ... */
} symbol_tables;

static symbol_tables find_tables(const struct link_map *map)
{
    symbol_tables it = {NULL, NULL, NULL, NULL};
    for (const ElfW(Dyn) *entry = map->l_ld; entry->d_tag != DT_NULL; ++entry) {
        const void *at = (const void *)entry->d_un.d_ptr; /* the loader has made it an address */
        switch (entry->d_tag) {
        case DT_SYMTAB:
            it.symbols = at;
            break;
        case DT_STRTAB:
            it.names = at;
            break;
        case DT_HASH:
            it.hash = at;
            break;
        case DT_GNU_HASH:
            it.gnu_hash = at;
            break;
        default:
            break;
        }
    }
    return it;
}

int mor_shared_object_imports(void *object, const char *name)
{
    struct link_map *map = NULL;
    if (dlinfo(object, RTLD_DI_LINKMAP, &map) != 0) {
        return 0;
    }
    const symbol_tables it = find_tables(map);
    const uint32_t n = it.hash != NULL ? it.hash[1] : it.gnu_hash != NULL ? it.gnu_hash[1] : 0;
    for (uint32_t k = 0; it.symbols != NULL && it.names != NULL && k < n; ++k) {
        if (it.symbols[k].st_shndx == SHN_UNDEF && strcmp(it.names + it.symbols[k].st_name, name) == 0) {
            return 1;
        }
    }
    return 0;
}

void mor_shared_object_close(void **object)
{
    if (*object != NULL) {
        dlclose(*object);
        *object = NULL;
    }
}
