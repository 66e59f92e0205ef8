// Finds the materials of an X file, and the names by which meshes refer to them. Text and binary
// files are split into words and braces in the same way as assimp does it.
#include "assets/x_references.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef enum TokenKind { TOKEN_END, TOKEN_OPEN, TOKEN_CLOSE, TOKEN_WORD, TOKEN_OTHER } TokenKind;

typedef struct Token {
    TokenKind kind;
    DipXSpan text;  // a word's characters
    DipXSpan whole; // the bytes of the token in the file
} Token;

// --- tokens of a text file -----------------------------------------------------------------------

static bool is_space(unsigned char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

static bool is_delimiter(unsigned char c) {
    return c == ';' || c == ',' || c == '{' || c == '}';
}

static const unsigned char *skip_line(const unsigned char *at, const unsigned char *end) {
    while (at < end && *at != '\n' && *at != '\r') {
        ++at;
    }
    return at;
}

static const unsigned char *skip_space(const unsigned char *at, const unsigned char *end) {
    while (at < end) {
        const bool comment = *at == '#' || (end - at > 1 && at[0] == '/' && at[1] == '/');
        if (!comment && !is_space(*at)) {
            break;
        }
        at = comment ? skip_line(at, end) : at + 1;
    }
    return at;
}

static Token next_in_text(const unsigned char *at, const unsigned char *end) {
    at = skip_space(at, end);
    Token token = {TOKEN_END, {at, at}, {at, at}};
    if (at == end) {
        return token;
    }
    const unsigned char *quote = *at == '"' ? memchr(at + 1, '"', (size_t)(end - at - 1)) : NULL;
    if (quote) {
        token.kind = TOKEN_OTHER;
        at = quote + 1;
    } else if (is_delimiter(*at)) {
        token.kind = *at == '{' ? TOKEN_OPEN : *at == '}' ? TOKEN_CLOSE : TOKEN_OTHER;
        ++at;
    } else {
        token.kind = TOKEN_WORD;
        while (at < end && !is_space(*at) && !is_delimiter(*at)) {
            ++at;
        }
    }
    token.text.end = token.whole.end = at;
    return token;
}

// --- tokens of a binary file ---------------------------------------------------------------------

static uint32_t number_of(const unsigned char *at, size_t bytes) {
    uint32_t number = 0;
    for (size_t i = 0; i < bytes; ++i) {
        number |= (uint32_t)at[i] << (8 * i);
    }
    return number;
}

// Returns how many bytes follow the number of a token and, if it has one, its count. Returns
// UINT64_MAX for a number that no token has. *counted: the token has a count.
static uint64_t payload_bytes(uint32_t number, uint32_t count, unsigned float_bytes,
                              bool *counted) {
    *counted = number == 1 || number == 2 || number == 6 || number == 7;
    switch (number) {
    case 1: // a name
        return count;
    case 2: // a string, and the token that ends it
        return (uint64_t)count + 2;
    case 3: // an integer
        return 4;
    case 5: // a GUID
        return 16;
    case 6: // a list of integers
        return (uint64_t)count * 4;
    case 7: // a list of floats
        return (uint64_t)count * float_bytes;
    default: // braces, brackets, separators and the words of templates
        return (number >= 0x0a && number <= 0x14) || number == 0x1f ||
                       (number >= 0x28 && number <= 0x34)
                   ? 0
                   : UINT64_MAX;
    }
}

static Token next_in_binary(const unsigned char *at, const unsigned char *end,
                            unsigned float_bytes) {
    static const char template_word[] = "template";
    Token token = {TOKEN_END, {at, at}, {at, at}};
    const size_t left = (size_t)(end - at);
    if (left < 2) {
        return token;
    }
    const uint32_t number = number_of(at, 2);
    const uint32_t count = left < 6 ? 0 : number_of(at + 2, 4);
    bool counted;
    const uint64_t payload = payload_bytes(number, count, float_bytes, &counted);
    const size_t head = counted ? 6 : 2;
    if (left < head || payload > left - head) {
        return token;
    }
    token.whole.end = at + head + payload;
    token.text = (DipXSpan){at + head, token.whole.end};
    token.kind = number == 0x0a   ? TOKEN_OPEN
                 : number == 0x0b ? TOKEN_CLOSE
                 : number == 1    ? TOKEN_WORD
                                  : TOKEN_OTHER;
    if (number == 0x1f) {
        const unsigned char *word = (const unsigned char *)template_word;
        token.kind = TOKEN_WORD;
        token.text = (DipXSpan){word, word + sizeof template_word - 1};
    }
    return token;
}

// --- blocks --------------------------------------------------------------------------------------

typedef struct Scan {
    DipXReferences *references;
    const unsigned char *end;
    Token words[2];        // the last words since another token
    int word_count;        // 0..2
    size_t depth;          // number of blocks that are open
    size_t list_depth;     // that of the open list of materials, counting itself; 0 outside
    size_t material_depth; // the same for the open material
    DipXBlock material;    // the open material
    bool material_is_read; // assimp reads the open material
} Scan;

static Token next_token(const Scan *scan, const unsigned char *at) {
    const DipXReferences *r = scan->references;
    return r->binary ? next_in_binary(at, scan->end, r->float_bytes) : next_in_text(at, scan->end);
}

static bool is_word(DipXSpan text, const char *word) {
    const size_t length = (size_t)(text.end - text.begin);
    return length == strlen(word) && memcmp(text.begin, word, length) == 0;
}

static bool add_reference(Scan *scan, const Token *open, const Token *name) {
    DipXReferences *r = scan->references;
    DipXReference *items = dip_array_grow(r->items, r->count, sizeof *items);
    if (items) {
        items[r->count++] = (DipXReference){.name = name->text, .brace = open->whole.begin};
        r->items = items;
    }
    return items != NULL;
}

// Keeps the material that has just ended, if it has a name.
static bool add_material(Scan *scan) {
    DipXReferences *r = scan->references;
    const DipXBlock block = scan->material;
    if (block.name.begin == block.name.end) {
        return true;
    }
    if (scan->material_is_read) {
        DipXSpan *names = dip_array_grow(r->readable, r->readable_count, sizeof *names);
        if (names) {
            names[r->readable_count++] = block.name;
            r->readable = names;
        }
        return names != NULL;
    }
    DipXBlock *blocks = dip_array_grow(r->blocks, r->block_count, sizeof *blocks);
    if (blocks) {
        blocks[r->block_count++] = block;
        r->blocks = blocks;
    }
    return blocks != NULL;
}

// Opens a block. The words before its brace are its type and, with two words, its name.
static void open_block(Scan *scan) {
    const Token *type = scan->word_count > 0 ? &scan->words[0] : NULL;
    const bool in_list = scan->list_depth > 0 && scan->depth == scan->list_depth;
    scan->depth++;
    if (!type || scan->material_depth > 0) {
        return;
    }
    if (is_word(type->text, "Material")) {
        const bool named = scan->word_count > 1;
        scan->material_depth = scan->depth;
        scan->material_is_read = in_list || scan->depth == 1;
        scan->material.name = named ? scan->words[1].text : (DipXSpan){NULL, NULL};
        scan->material.whole = type->whole;
    } else if (scan->list_depth == 0 && is_word(type->text, "MeshMaterialList")) {
        scan->list_depth = scan->depth;
    }
}

static bool close_block(Scan *scan, const Token *token) {
    bool ok = true;
    if (scan->depth == 0) {
        return true; // assimp ignores a brace that closes nothing.
    }
    if (scan->depth == scan->material_depth) {
        scan->material.whole.end = token->whole.end;
        scan->material_depth = 0;
        ok = add_material(scan);
    } else if (scan->depth == scan->list_depth) {
        scan->list_depth = 0;
    }
    scan->depth--;
    return ok;
}

// Takes the tokens "{ name }" in a list of materials. Returns the token that follows the brace, or
// the closing one after a name. *ok becomes false when memory runs out.
static Token take_entry(Scan *scan, const Token *open, bool *ok) {
    const Token name = next_token(scan, open->whole.end);
    if (name.kind != TOKEN_WORD) {
        scan->depth++;
        return name;
    }
    const Token close = next_token(scan, name.whole.end);
    scan->depth++;
    if (close.kind == TOKEN_CLOSE) {
        *ok = add_reference(scan, open, &name);
    }
    return close;
}

static void add_word(Scan *scan, const Token *token) {
    if (scan->word_count == 2) {
        scan->words[0] = scan->words[1];
        scan->word_count = 1;
    }
    scan->words[scan->word_count++] = *token;
}

bool dip_x_scan(DipXReferences *references) {
    Scan scan = {.references = references, .end = references->bytes + references->size_bytes};
    const unsigned char *start = references->bytes + DIP_X_HEADER_BYTES;
    start = references->binary ? start : skip_line(start, scan.end);
    bool ok = true;
    Token token = next_token(&scan, start);
    while (ok && token.kind != TOKEN_END) {
        const Token seen = token;
        const bool entry = seen.kind == TOKEN_OPEN && scan.word_count == 0 && scan.list_depth > 0 &&
                           scan.depth == scan.list_depth && scan.material_depth == 0;
        if (entry) {
            token = take_entry(&scan, &seen, &ok);
            continue;
        }
        if (seen.kind == TOKEN_OPEN) {
            open_block(&scan);
        } else if (seen.kind == TOKEN_CLOSE) {
            ok = close_block(&scan, &seen);
        }
        if (seen.kind == TOKEN_WORD) {
            add_word(&scan, &seen);
        } else {
            scan.word_count = 0;
        }
        token = next_token(&scan, seen.whole.end);
    }
    if (scan.depth > 0) {
        references->count = 0;
    }
    return ok;
}
