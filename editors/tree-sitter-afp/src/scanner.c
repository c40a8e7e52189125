// Units behind numbers. A unit stands on the line of its number, and is a name where something is bound to it.

#include "tree_sitter/parser.h"

#include <string.h>

enum Token { UNIT, ERROR_SENTINEL };

// From crates/afp-types/src/units.rs, as AFP_BLESS=1 cargo test -p afp-syntax --test editors writes it.
static const char *const SINGLES[] = {
    "m", "km", "cm", "mm", "um", "rad", "mrad", "deg", "s", "ms", "us", "ns", "min",
    "h", "kg", "g", "N", "mN", "kN", "V", "mV", "K", "degC", "Hz", "kHz", "MHz",
};

#define LONGEST 4

static bool is_digit(int32_t c) { return c >= '0' && c <= '9'; }

static bool is_word(int32_t c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || is_digit(c);
}

static bool is_blank(int32_t c) { return c == ' ' || c == '\t' || c == '\r'; }

// Takes a single unit and marks its end; an exponent that is none stays outside.
static bool part(TSLexer *lexer) {
    char word[LONGEST + 1] = {0};
    unsigned length = 0;
    for (; is_word(lexer->lookahead); length++) {
        if (length >= LONGEST) return false;
        word[length] = (char)lexer->lookahead;
        lexer->advance(lexer, false);
    }
    bool known = false;
    for (unsigned i = 0; i < sizeof SINGLES / sizeof *SINGLES; i++) {
        known = known || strcmp(word, SINGLES[i]) == 0;
    }
    if (!known) return false;
    lexer->mark_end(lexer);
    return true;
}

// Takes the exponent of a unit, if there is one. Returns whether the text may go on.
static bool exponent(TSLexer *lexer) {
    if (lexer->lookahead != '^') return true;
    lexer->advance(lexer, false);
    if (lexer->lookahead == '-') lexer->advance(lexer, false);
    if (!is_digit(lexer->lookahead)) return false;
    while (is_digit(lexer->lookahead)) lexer->advance(lexer, false);
    lexer->mark_end(lexer);
    return true;
}

// Whether a name stood here instead: '=', '=>' or '->' follows.
static bool is_bound(TSLexer *lexer) {
    while (is_blank(lexer->lookahead) || lexer->lookahead == '\n') lexer->advance(lexer, false);
    int32_t first = lexer->lookahead;
    if (first != '=' && first != '-') return false;
    lexer->advance(lexer, false);
    return first == '=' ? lexer->lookahead != '=' : lexer->lookahead == '>';
}

void *tree_sitter_afp_external_scanner_create(void) { return NULL; }

void tree_sitter_afp_external_scanner_destroy(void *payload) { (void)payload; }

unsigned tree_sitter_afp_external_scanner_serialize(void *payload, char *buffer) {
    (void)payload;
    (void)buffer;
    return 0;
}

void tree_sitter_afp_external_scanner_deserialize(void *payload, const char *buffer, unsigned length) {
    (void)payload;
    (void)buffer;
    (void)length;
}

bool tree_sitter_afp_external_scanner_scan(void *payload, TSLexer *lexer, const bool *valid) {
    (void)payload;
    // While an error is passed over everything is asked for.
    if (!valid[UNIT] || valid[ERROR_SENTINEL]) return false;
    while (is_blank(lexer->lookahead)) lexer->advance(lexer, true);
    if (!part(lexer)) return false;
    lexer->result_symbol = UNIT;
    bool goes_on = exponent(lexer);
    while (goes_on && (lexer->lookahead == '*' || lexer->lookahead == '/')) {
        lexer->advance(lexer, false);
        goes_on = part(lexer) && exponent(lexer);
    }
    return !goes_on || !is_bound(lexer);
}
