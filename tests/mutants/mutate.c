/* SPDX-License-Identifier: MIT */
/* Puts all mutants of some C files into one program, each behind a number:
 *     mutate LIST ROOMS IN.i OUT.c [IN.i OUT.c]...
 * IN.i is C after the preprocessor; OUT.c is the same with mutants in the functions and tables
 * whose source is in one of ROOMS, such as firmware/lib/:firmware/brake/. LIST gets one line a
 * mutant, with tabs: its number, its function's number, its line's number, its file, its function,
 * the line of source, what is changed and, from the second one on, which of equal changes of equal
 * lines in that function it is. Where two files hold the same mutant, as with an inline function of
 * a header or a file that is compiled with several settings, it has one number.
 *
 * At run time MUTANT=N chooses mutant N (mutant.c); with 0 the program does what its source says.
 *
 * What is changed:
 *     an operator             < and <=, > and >=, and their opposites, + and -, << and >>, & and |,
 *                             ++ and --, && and ||; each side of && and || is left out; ! - ~ are
 *                             left out
 *     a constant              one more, one less; true is false; a real number: 1 % more
 *     a condition             is its opposite
 *     a statement             is left out
 *     a number of a constant  one more, one less; a real number: 1 % more
 *     or a table of a file */
#include <clang-c/Index.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- the text and its edits ------------------------------------------------------------------- */

static char *source;
static size_t source_size;

struct edit {
    size_t at, skip; /* `skip` characters from `at` on are left out */
    size_t order;
    char *text;
};
static struct edit *edits;
static size_t edit_count, edit_room;

static void fail(const char *what, const char *which)
{
    fprintf(stderr, "mutate: error: %s: %s\n", which, what);
    exit(1);
}

static void *grown(void *data, size_t bytes)
{
    data = realloc(data, bytes);
    if (data == NULL) {
        fail("no memory", "mutate");
    }
    return data;
}

/* Edits at one place come in the order of the calls. */
static void edit(size_t at, size_t skip, const char *format, ...)
{
    char text[1000];
    va_list values;

    va_start(values, format);
    vsnprintf(text, sizeof text, format, values);
    va_end(values);
    if (edit_count == edit_room) {
        edit_room = edit_room * 2 + 1000;
        edits = grown(edits, edit_room * sizeof *edits);
    }
    edits[edit_count] = (struct edit){at, skip, edit_count, strdup(text)};
    edit_count++;
}

static int compare_edits(const void *a, const void *b)
{
    const struct edit *x = a, *y = b;

    if (x->at != y->at) {
        return x->at < y->at ? -1 : 1;
    }
    return x->order < y->order ? -1 : 1;
}

static void write_edited(const char *path)
{
    FILE *file = fopen(path, "w");
    size_t at = 0;

    if (file == NULL) {
        fail("cannot write", path);
    }
    fputs("#include \"tests/mutants/mutant.h\"\n", file);
    qsort(edits, edit_count, sizeof *edits, compare_edits);
    for (size_t i = 0; i < edit_count; i++) {
        if (edits[i].at > at) {
            fwrite(source + at, 1, edits[i].at - at, file);
            at = edits[i].at;
        }
        fputs(edits[i].text, file);
        if (edits[i].at + edits[i].skip > at) {
            at = edits[i].at + edits[i].skip;
        }
        free(edits[i].text);
    }
    fwrite(source + at, 1, source_size - at, file);
    if (fclose(file) != 0) {
        fail("cannot write", path);
    }
    edit_count = 0;
}

static char *read_all(const char *path, size_t *size)
{
    FILE *file = fopen(path, "r");
    char *text = NULL;
    size_t used = 0, got;

    if (file == NULL) {
        fail("cannot read", path);
    }
    do {
        text = grown(text, used + 65537);
        got = fread(text + used, 1, 65536, file);
        used += got;
    } while (got != 0);
    fclose(file);
    text[used] = '\0';
    *size = used;
    return text;
}

/* --- the list of mutants ---------------------------------------------------------------------- */

static struct {
    char *key; /* file, function, text of the line, change, which */
    unsigned line, function;
} *mutants;
static unsigned mutant_count;
static char **functions; /* file and name */
static unsigned function_count, function_number;
static const char *rooms, *function = "";

/* Of this file: how often each key without its last part was seen. */
static struct seen {
    char *key;
    unsigned count;
} *seen;
static unsigned seen_count;

static unsigned number_of_equals(const char *key)
{
    for (unsigned i = 0; i < seen_count; i++) {
        if (strcmp(seen[i].key, key) == 0) {
            return ++seen[i].count;
        }
    }
    seen = grown(seen, (seen_count + 1) * sizeof *seen);
    seen[seen_count++] = (struct seen){strdup(key), 1};
    return 1;
}

static void forget_seen(void)
{
    while (seen_count != 0) {
        free(seen[--seen_count].key);
    }
}

static size_t offset_of(CXSourceLocation location)
{
    unsigned offset;

    clang_getFileLocation(location, NULL, NULL, NULL, &offset);
    return offset;
}

static size_t begin_of(CXCursor cursor)
{
    return offset_of(clang_getRangeStart(clang_getCursorExtent(cursor)));
}

static size_t end_of(CXCursor cursor)
{
    return offset_of(clang_getRangeEnd(clang_getCursorExtent(cursor)));
}

/* A test may include a file as ../../firmware/lib/file.c. */
static const char *from_root(const char *path)
{
    const char *up = strstr(path, "../");

    while (up != NULL) {
        path = up + 3;
        up = strstr(path, "../");
    }
    return path;
}

/* The line of the original source, without the blanks around it. */
static void line_of(const char *path, unsigned line, char *text, size_t size)
{
    static char *cached, *cached_path;
    const char *at;
    size_t length;

    if (cached_path == NULL || strcmp(cached_path, path) != 0) {
        free(cached_path);
        free(cached);
        cached_path = strdup(path);
        cached = read_all(path, &length);
    }
    at = cached;
    while (--line != 0 && at != NULL) {
        at = strchr(at, '\n');
        at = at == NULL ? NULL : at + 1;
    }
    if (at == NULL) {
        fail("has no such line", path);
    }
    at += strspn(at, " \t");
    length = strcspn(at, "\n");
    snprintf(text, size, "%.*s", (int)length, at);
    for (char *c = text; *c != '\0'; c++) {
        if (*c == '\t') {
            *c = ' ';
        }
    }
}

/* The number of the mutant that changes something at `location`. */
static unsigned mutant(CXSourceLocation location, const char *format, ...)
{
    char change[200], line_text[400], key[1200];
    CXString path;
    unsigned line, equals;
    va_list values;

    va_start(values, format);
    vsnprintf(change, sizeof change, format, values);
    va_end(values);
    clang_getPresumedLocation(location, &path, &line, NULL);
    line_of(from_root(clang_getCString(path)), line, line_text, sizeof line_text);
    snprintf(key, sizeof key, "%s\t%s\t%s\t%s", from_root(clang_getCString(path)), function,
             line_text, change);
    clang_disposeString(path);
    equals = number_of_equals(key);
    if (equals > 1) {
        snprintf(key + strlen(key), sizeof key - strlen(key), "\t%u", equals);
    }
    for (unsigned i = 0; i < mutant_count; i++) {
        if (strcmp(mutants[i].key, key) == 0) {
            return i + 1;
        }
    }
    mutants = grown(mutants, (mutant_count + 1) * sizeof *mutants);
    mutants[mutant_count].key = strdup(key);
    mutants[mutant_count].function = function_number;
    mutants[mutant_count++].line = line;
    return mutant_count;
}

/* From here on, mutants are of that function or table. */
static void begin_function(CXSourceLocation location, const char *name)
{
    CXString path;
    char text[400];
    unsigned i = 0;

    clang_getPresumedLocation(location, &path, NULL, NULL);
    snprintf(text, sizeof text, "%s\t%s", from_root(clang_getCString(path)), name);
    clang_disposeString(path);
    while (i < function_count && strcmp(functions[i], text) != 0) {
        i++;
    }
    if (i == function_count) {
        functions = grown(functions, (function_count + 1) * sizeof *functions);
        functions[function_count++] = strdup(text);
    }
    function = name;
    function_number = i;
}

static CXSourceLocation start(CXCursor cursor)
{
    return clang_getRangeStart(clang_getCursorExtent(cursor));
}

static bool is_in_a_room(CXCursor cursor)
{
    CXString path;
    const char *room = rooms;
    bool is = false;

    clang_getPresumedLocation(start(cursor), &path, NULL, NULL);
    while (*room != '\0' && !is) {
        size_t length = strcspn(room, ":");

        is = strncmp(from_root(clang_getCString(path)), room, length) == 0;
        room += length + (room[length] == ':');
    }
    clang_disposeString(path);
    return is;
}

/* --- the tree --------------------------------------------------------------------------------- */

enum { CHILDREN_MAX = 2000 };
struct children {
    CXCursor child[CHILDREN_MAX];
    unsigned count;
};

static enum CXChildVisitResult add_child(CXCursor cursor, CXCursor parent, CXClientData data)
{
    struct children *children = data;

    (void)parent;
    if (children->count == CHILDREN_MAX) {
        fail("too many parts in one", "a table or block");
    }
    children->child[children->count++] = cursor;
    return CXChildVisit_Continue;
}

static struct children *children_of(CXCursor cursor)
{
    struct children *children = grown(NULL, sizeof *children);

    children->count = 0;
    clang_visitChildren(cursor, add_child, children);
    return children;
}

static enum CXCursorKind kind_of(CXCursor cursor)
{
    return clang_getCursorKind(cursor);
}

/* Without the conversions and parentheses around it. */
static CXCursor bare(CXCursor cursor)
{
    while (kind_of(cursor) == CXCursor_UnexposedExpr || kind_of(cursor) == CXCursor_ParenExpr) {
        struct children *children = children_of(cursor);
        unsigned count = children->count;
        CXCursor child = children->child[0];

        free(children);
        if (count != 1) {
            break;
        }
        cursor = child;
    }
    return cursor;
}

static CXType type_of(CXCursor cursor)
{
    return clang_getCanonicalType(clang_getCursorType(cursor));
}

static bool is_pointer(CXCursor cursor)
{
    enum CXTypeKind kind = type_of(cursor).kind;

    return kind == CXType_Pointer || kind == CXType_ConstantArray ||
           kind == CXType_IncompleteArray || kind == CXType_VariableArray;
}

static bool is_real(CXCursor cursor)
{
    enum CXTypeKind kind = type_of(cursor).kind;

    return kind == CXType_Float || kind == CXType_Double || kind == CXType_LongDouble;
}

static bool is_integer(CXCursor cursor)
{
    enum CXTypeKind kind = type_of(cursor).kind;

    return (kind >= CXType_Bool && kind <= CXType_Int128) || kind == CXType_Enum;
}

/* Made of literals and enumerators alone. */
static bool is_constant(CXCursor cursor)
{
    struct children *children;
    bool is = true;

    switch (kind_of(cursor)) {
    case CXCursor_IntegerLiteral:
    case CXCursor_CharacterLiteral:
    case CXCursor_FloatingLiteral:
    case CXCursor_UnaryExpr: /* sizeof */
        return true;
    case CXCursor_DeclRefExpr:
        return kind_of(clang_getCursorReferenced(cursor)) == CXCursor_EnumConstantDecl;
    case CXCursor_TypeRef:
        return true;
    case CXCursor_UnexposedExpr:
    case CXCursor_ParenExpr:
    case CXCursor_CStyleCastExpr:
    case CXCursor_UnaryOperator:
    case CXCursor_BinaryOperator:
    case CXCursor_ConditionalOperator:
        break;
    default:
        return false;
    }
    children = children_of(cursor);
    for (unsigned i = 0; i < children->count && is; i++) {
        is = is_constant(children->child[i]);
    }
    is = is && children->count != 0;
    free(children);
    return is;
}

static void visit(CXCursor cursor);

static void visit_all(CXCursor cursor)
{
    struct children *children = children_of(cursor);

    for (unsigned i = 0; i < children->count; i++) {
        visit(children->child[i]);
    }
    free(children);
}

/* The text between two places, without blanks. */
static void text_between(size_t from, size_t to, char *text, size_t size)
{
    size_t used = 0;

    while (from < to && used + 1 < size) {
        if (strchr(" \t\n", source[from]) == NULL) {
            text[used++] = source[from];
        }
        from++;
    }
    text[used] = '\0';
}

/* --- constants -------------------------------------------------------------------------------- */

static void mutate_constant(CXCursor cursor)
{
    size_t from = begin_of(cursor), to = end_of(cursor);
    CXEvalResult result;
    long long value;

    if (is_pointer(cursor)) {
        return;
    }
    if (is_real(cursor)) {
        char text[60];

        text_between(from, to, text, sizeof text);
        if (strtod(text, NULL) == 0 && strspn(text, "0.") == strlen(text)) {
            return; /* 1 % of nothing */
        }
        edit(from, 0, "((");
        edit(to, 0, ")*(1+0.01*IS(%u)))", mutant(start(cursor), "%s -> 1 %% more", text));
        return;
    }
    if (!is_integer(cursor)) {
        return;
    }
    result = clang_Cursor_Evaluate(cursor);
    if (result == NULL || clang_EvalResult_getKind(result) != CXEval_Int) {
        clang_EvalResult_dispose(result);
        return;
    }
    value = clang_EvalResult_getAsLongLong(result);
    clang_EvalResult_dispose(result);
    edit(from, 0, "((");
    if (type_of(cursor).kind == CXType_Bool) {
        edit(to, 0, ")^IS(%u))",
             mutant(start(cursor), "%s", value ? "true -> false" : "false -> true"));
    } else {
        unsigned more = mutant(start(cursor), "%lld -> %lld", value, value + 1);
        unsigned less = mutant(start(cursor), "%lld -> %lld", value, value - 1);

        edit(to, 0, ")+(IS(%u)-IS(%u)))", more, less);
    }
}

/* --- operators -------------------------------------------------------------------------------- */

static const struct {
    const char *op, *other[2];
} swaps[] = {
    {"<", {"<=", ">="}}, {"<=", {"<", ">"}}, {">", {">=", "<="}}, {">=", {">", "<"}},
    {"==", {"!="}},      {"!=", {"=="}},     {"+", {"-"}},        {"-", {"+"}},
    {"*", {"+"}},        {"/", {"*"}},       {"%", {"*"}},        {"<<", {">>"}},
    {">>", {"<<"}},      {"&", {"|"}},       {"|", {"&"}},        {"^", {"|"}},
};
static unsigned temporaries;

static unsigned find_swap(const char *op)
{
    unsigned i = 0;

    while (i < sizeof swaps / sizeof swaps[0] && strcmp(swaps[i].op, op) != 0) {
        i++;
    }
    return i;
}

static bool is_comparison(CXCursor cursor)
{
    struct children *children;
    char op[8];

    cursor = bare(cursor);
    if (kind_of(cursor) != CXCursor_BinaryOperator) {
        return false;
    }
    children = children_of(cursor);
    text_between(end_of(children->child[0]), begin_of(children->child[1]), op, sizeof op);
    free(children);
    return find_swap(op) < 6;
}

/* A && B is `A ? B : A`, A || B is `A ? A : B`. */
static void mutate_logic(CXCursor cursor, CXCursor left, CXCursor right, bool is_and)
{
    CXSourceLocation at = clang_getRangeEnd(clang_getCursorExtent(left));
    const char *neutral = is_and ? "|IS" : "&!IS";
    unsigned n = ++temporaries;
    unsigned other = mutant(at, is_and ? "&& -> ||" : "|| -> &&");
    unsigned no_left = mutant(at, is_and ? "left of && dropped" : "left of || dropped");
    unsigned no_right = mutant(at, is_and ? "right of && dropped" : "right of || dropped");

    edit(begin_of(cursor), 0, "({_Bool _a%u=((_Bool)(", n);
    visit(left);
    edit(end_of(left), begin_of(right) - end_of(left), "))%s(%u);(_a%u%sIS(%u))?((_Bool)(", neutral,
         no_left, n, is_and ? "!=" : "==", other);
    visit(right);
    edit(end_of(cursor), 0, "))%s(%u):_a%u;})", neutral, no_right, n);
}

static void mutate_binary(CXCursor cursor)
{
    struct children *children = children_of(cursor);
    CXCursor left = children->child[0], right = children->child[1];
    CXSourceLocation at = clang_getRangeEnd(clang_getCursorExtent(left));
    char op[8];
    unsigned swap, n;

    free(children);
    text_between(end_of(left), begin_of(right), op, sizeof op);
    if (strcmp(op, "&&") == 0 || strcmp(op, "||") == 0) {
        mutate_logic(cursor, left, right, op[0] == '&');
        return;
    }
    swap = find_swap(op);
    if (swap == sizeof swaps / sizeof swaps[0] || (is_pointer(right) && swap >= 6)) {
        visit(left);
        visit(right);
        return;
    }
    /* Real numbers that are compared are hardly ever equal. */
    n = ++temporaries;
    edit(begin_of(cursor), 0, "({__auto_type _a%u=(", n);
    visit(left);
    edit(end_of(left), begin_of(right) - end_of(left), ");__auto_type _b%u=(", n);
    visit(right);
    edit(end_of(cursor), 0, ");");
    for (unsigned i = 0; i < 2 && swaps[swap].other[i] != NULL; i++) {
        const char *other = swaps[swap].other[i];

        if (i == 0 && swap < 4 && is_real(left)) {
            continue;
        }
        edit(end_of(cursor), 0, "IS(%u)?_a%u%s_b%u:", mutant(at, "%s -> %s", op, other), n, other,
             n);
    }
    edit(end_of(cursor), 0, "_a%u%s_b%u;})", n, op, n);
}

static void mutate_compound_assignment(CXCursor cursor)
{
    struct children *children = children_of(cursor);
    CXCursor left = children->child[0], right = children->child[1];
    CXSourceLocation at = clang_getRangeEnd(clang_getCursorExtent(left));
    char op[8];
    unsigned swap, n = ++temporaries;

    free(children);
    text_between(end_of(left), begin_of(right), op, sizeof op);
    op[strlen(op) - 1] = '\0';
    swap = find_swap(op);
    edit(begin_of(cursor), 0, "({__auto_type _a%u=&(", n);
    visit(left);
    edit(end_of(left), begin_of(right) - end_of(left), ");__auto_type _b%u=(", n);
    visit(right);
    edit(end_of(cursor), 0, ");IS(%u)?(*_a%u%s=_b%u):(*_a%u%s=_b%u);})",
         mutant(at, "%s= -> %s=", op, swaps[swap].other[0]), n, swaps[swap].other[0], n, n, op, n);
}

static void mutate_unary(CXCursor cursor)
{
    struct children *children = children_of(cursor);
    CXCursor child = children->child[0];
    size_t from = begin_of(cursor), to = end_of(cursor), child_from = begin_of(child);
    bool is_prefix = child_from > from;
    unsigned n = ++temporaries;
    char op[8];

    free(children);
    text_between(is_prefix ? from : end_of(child), is_prefix ? child_from : to, op, sizeof op);
    if (strcmp(op, "!") == 0) {
        edit(from, 0, "(IS(%u)^", mutant(start(cursor), "! dropped"));
        visit(child);
        edit(to, 0, ")");
    } else if (strcmp(op, "-") == 0 || strcmp(op, "~") == 0) {
        edit(from, child_from - from, "({__auto_type _a%u=(", n);
        visit(child);
        edit(to, 0, ");IS(%u)?+_a%u:%s_a%u;})", mutant(start(cursor), "%s dropped", op), n, op, n);
    } else if (strcmp(op, "++") == 0 || strcmp(op, "--") == 0) {
        const char *other = op[0] == '+' ? "--" : "++";

        edit(from, is_prefix ? child_from - from : 0, "({__auto_type _a%u=&(", n);
        visit(child);
        edit(end_of(child), to - end_of(child), ");IS(%u)?%s(*_a%u)%s:%s(*_a%u)%s;})",
             mutant(start(cursor), "%s -> %s", op, other), is_prefix ? other : "", n,
             is_prefix ? "" : other, is_prefix ? op : "", n, is_prefix ? "" : op);
    } else {
        visit(child);
    }
}

/* --- statements ------------------------------------------------------------------------------- */

static void visit_condition(CXCursor condition)
{
    CXCursor inner = bare(condition);
    char first = source[begin_of(inner)];

    if (is_constant(condition)) { /* for ever */
        return;
    }
    if (is_comparison(condition) || (kind_of(inner) == CXCursor_UnaryOperator && first == '!')) {
        visit(condition);
        return;
    }
    edit(begin_of(condition), 0, "(IS(%u)^!!(", mutant(start(condition), "condition negated"));
    visit(condition);
    edit(end_of(condition), 0, "))");
}

static bool can_be_dropped(CXCursor statement)
{
    switch (kind_of(statement)) {
    case CXCursor_UnexposedExpr:
    case CXCursor_ParenExpr:
    case CXCursor_CStyleCastExpr:
    case CXCursor_CallExpr:
    case CXCursor_BinaryOperator:
    case CXCursor_CompoundAssignOperator:
    case CXCursor_UnaryOperator:
    case CXCursor_BreakStmt:
    case CXCursor_ContinueStmt:
    case CXCursor_ReturnStmt:
        return true;
    default:
        return false;
    }
}

/* (void)x; does nothing. */
static bool is_nothing(CXCursor statement)
{
    return kind_of(statement) == CXCursor_CStyleCastExpr &&
           kind_of(bare(statement)) == CXCursor_CStyleCastExpr &&
           strncmp(source + begin_of(statement), "(void)", 6) == 0;
}

static void visit_statement(CXCursor statement, bool is_last)
{
    if (can_be_dropped(statement) && !is_nothing(statement) &&
        !(is_last && kind_of(statement) == CXCursor_ReturnStmt)) {
        size_t to = end_of(statement);

        edit(begin_of(statement), 0, "if(!IS(%u)){", mutant(start(statement), "dropped"));
        visit(statement);
        to += strcspn(source + to, ";") + 1;
        edit(to, 0, "}");
        return;
    }
    visit(statement);
}

/* A loop counts its rounds: a mutant may never end. */
static void count_rounds(CXCursor body)
{
    if (kind_of(body) == CXCursor_CompoundStmt) {
        edit(begin_of(body) + 1, 0, "mutant_round();");
    }
}

static void visit_for(CXCursor cursor)
{
    struct children *children = children_of(cursor);

    count_rounds(children->child[children->count - 1]);
    for (unsigned i = 0; i < children->count; i++) {
        CXCursor child = children->child[i];
        unsigned semicolons = 0;

        for (size_t at = begin_of(cursor); at < begin_of(child); at++) {
            semicolons += source[at] == ';';
        }
        if (semicolons == 1 && i + 1 < children->count) {
            visit_condition(child);
        } else {
            visit(child);
        }
    }
    free(children);
}

static bool is_bool_value(CXCursor cursor)
{
    enum CXCursorKind kind = kind_of(bare(cursor));

    return type_of(bare(cursor)).kind == CXType_Bool &&
           (kind == CXCursor_DeclRefExpr || kind == CXCursor_MemberRefExpr ||
            kind == CXCursor_CallExpr);
}

/* --- constants of a file ---------------------------------------------------------------------- */

static char *changes; /* statements, of which each changes one number */
static size_t changes_size, changes_used;

static void add_change(const char *format, ...)
{
    va_list values;

    if (changes_size - changes_used < 200) {
        changes_size = changes_size * 2 + 10000;
        changes = grown(changes, changes_size);
    }
    va_start(values, format);
    changes_used +=
        (size_t)vsnprintf(changes + changes_used, changes_size - changes_used, format, values);
    va_end(values);
}

/* The numbers of a table or of a constant that is no table, which has one. */
static unsigned change_numbers(CXCursor value, unsigned place)
{
    if (kind_of(value) == CXCursor_InitListExpr) {
        struct children *children = children_of(value);

        for (unsigned i = 0; i < children->count; i++) {
            place = change_numbers(children->child[i], place);
        }
        free(children);
    } else if (is_constant(value) && is_real(value)) {
        add_change("_t[%u]*=1+0.01*IS(%u);", place,
                   mutant(start(value), "%s: number %u 1 %% more", function, place));
        place++;
    } else if (is_constant(value) && is_integer(value)) {
        unsigned more = mutant(start(value), "%s: number %u one more", function, place);
        unsigned less = mutant(start(value), "%s: number %u one less", function, place);

        add_change("_t[%u]+=IS(%u)-IS(%u);", place, more, less);
        place++;
    }
    return place;
}

static bool is_of_numbers(CXType type)
{
    return type.kind == CXType_Double || (type.kind > CXType_Bool && type.kind <= CXType_Int128);
}

static void drop_const(size_t from, size_t to)
{
    for (char *c = source + from; c < source + to; c++) {
        if (strncmp(c, "const ", 6) == 0) {
            edit((size_t)(c - source), 6, "");
        }
    }
}

/* They are changed before main begins. */
static void visit_constant(CXCursor variable)
{
    struct children *children = children_of(variable);
    CXType type = type_of(variable);
    CXString name = clang_getCursorSpelling(variable);
    size_t from = begin_of(variable), to = end_of(variable);
    CXCursor value = clang_getNullCursor();
    bool is_const = clang_isConstQualifiedType(type);
    static const char *const integers[] = {[1] = "unsigned char",
                                           [2] = "unsigned short",
                                           [4] = "unsigned",
                                           [8] = "unsigned long long"};

    if (children->count != 0 && end_of(children->child[children->count - 1]) == to) {
        value = children->child[children->count - 1];
    }
    free(children);
    while (type.kind == CXType_ConstantArray) {
        type = clang_getCanonicalType(clang_getArrayElementType(type));
        is_const = is_const || clang_isConstQualifiedType(type);
    }
    if (!is_of_numbers(type) || !is_const ||
        (clang_Cursor_isNull(value) && clang_Cursor_getStorageClass(variable) != CX_SC_Extern)) {
        clang_disposeString(name);
        return;
    }
    drop_const(from, to);
    if (clang_Cursor_isNull(value)) { /* it is defined elsewhere */
        clang_disposeString(name);
        return;
    }
    changes_used = 0;
    begin_function(start(variable), clang_getCString(name));
    (void)change_numbers(value, 0);
    to += strcspn(source + to, ";") + 1;
    edit(to, 0,
         "__attribute__((constructor)) static void "
         "_table%u(void){mutant_enter(%u);%s*_t=(void*)&%s;",
         ++temporaries, function_number,
         type.kind == CXType_Double ? "double" : integers[clang_Type_getSizeOf(type)], function);
    for (size_t at = 0; at < changes_used;) {
        size_t length = strcspn(changes + at, ";") + 1;

        edit(to, 0, "%.*s", (int)length, changes + at);
        at += length;
    }
    edit(to, 0, "}");
    clang_disposeString(name);
}

static void visit(CXCursor cursor)
{
    struct children *children;

    if (kind_of(cursor) == CXCursor_UnaryExpr) { /* sizeof: what the compiler knows */
        return;
    }
    if (clang_isExpression(kind_of(cursor)) && is_constant(cursor)) {
        mutate_constant(cursor);
        return;
    }
    switch (kind_of(cursor)) {
    case CXCursor_BinaryOperator:
        mutate_binary(cursor);
        return;
    case CXCursor_CompoundAssignOperator:
        mutate_compound_assignment(cursor);
        return;
    case CXCursor_UnaryOperator:
        mutate_unary(cursor);
        return;
    case CXCursor_ForStmt:
        visit_for(cursor);
        return;
    case CXCursor_IfStmt:
    case CXCursor_WhileStmt:
    case CXCursor_ConditionalOperator:
        children = children_of(cursor);
        if (kind_of(cursor) == CXCursor_WhileStmt) {
            count_rounds(children->child[1]);
        }
        visit_condition(children->child[0]);
        for (unsigned i = 1; i < children->count; i++) {
            visit(children->child[i]);
        }
        free(children);
        return;
    case CXCursor_DoStmt:
        children = children_of(cursor);
        count_rounds(children->child[0]);
        visit(children->child[0]);
        visit_condition(children->child[1]);
        free(children);
        return;
    case CXCursor_CaseStmt: /* its labels, one or the two ends of a range, must stay constants */
        children = children_of(cursor);
        visit_statement(children->child[children->count - 1], false);
        free(children);
        return;
    case CXCursor_DefaultStmt:
        children = children_of(cursor);
        visit_statement(children->child[0], false);
        free(children);
        return;
    case CXCursor_CompoundStmt:
        children = children_of(cursor);
        for (unsigned i = 0; i < children->count; i++) {
            visit_statement(children->child[i], i + 1 == children->count);
        }
        free(children);
        return;
    case CXCursor_ReturnStmt:
        children = children_of(cursor);
        if (children->count == 1 && is_bool_value(children->child[0])) {
            CXCursor value = children->child[0];

            edit(begin_of(value), 0, "(IS(%u)^!!(", mutant(start(value), "result negated"));
            visit(value);
            edit(end_of(value), 0, "))");
        } else if (children->count == 1) {
            visit(children->child[0]);
        }
        free(children);
        return;
    case CXCursor_VarDecl:
        if (clang_Cursor_getStorageClass(cursor) == CX_SC_Static) {
            return;
        }
        children = children_of(cursor);
        for (unsigned i = 0; i < children->count; i++) {
            if (end_of(children->child[i]) == end_of(cursor) &&
                clang_isExpression(kind_of(children->child[i]))) {
                visit(children->child[i]); /* the value to begin with */
            }
        }
        free(children);
        return;
    case CXCursor_TypeRef:
    case CXCursor_EnumDecl: /* must stay constants */
    case CXCursor_StructDecl:
    case CXCursor_StaticAssert:
        return;
    default:
        visit_all(cursor);
    }
}

static enum CXChildVisitResult visit_top(CXCursor cursor, CXCursor parent, CXClientData data)
{
    (void)parent;
    (void)data;
    if (kind_of(cursor) == CXCursor_FunctionDecl && clang_isCursorDefinition(cursor) &&
        is_in_a_room(cursor)) {
        CXString name = clang_getCursorSpelling(cursor);
        struct children *children = children_of(cursor);

        begin_function(start(cursor), clang_getCString(name));
        edit(begin_of(children->child[children->count - 1]) + 1, 0, "mutant_enter(%u);",
             function_number);
        visit(children->child[children->count - 1]);
        free(children);
        clang_disposeString(name);
    } else if (kind_of(cursor) == CXCursor_VarDecl &&
               (is_in_a_room(cursor) || clang_Cursor_getStorageClass(cursor) == CX_SC_Extern)) {
        visit_constant(cursor);
    }
    return CXChildVisit_Continue;
}

static void mutate(CXIndex index, const char *from, const char *to)
{
    static const char *const options[] = {"-xcpp-output", "-std=gnu11", "-w"};
    CXTranslationUnit unit;

    source = read_all(from, &source_size);
    unit = clang_parseTranslationUnit(index, from, options, 3, NULL, 0, 0);
    if (unit == NULL) {
        fail("cannot parse", from);
    }
    for (unsigned i = 0; i < clang_getNumDiagnostics(unit); i++) {
        CXDiagnostic diagnostic = clang_getDiagnostic(unit, i);

        if (clang_getDiagnosticSeverity(diagnostic) >= CXDiagnostic_Error) {
            CXString text = clang_formatDiagnostic(diagnostic, CXDiagnostic_DisplaySourceLocation);

            fail(clang_getCString(text), from);
        }
        clang_disposeDiagnostic(diagnostic);
    }
    temporaries = 0;
    forget_seen();
    clang_visitChildren(clang_getTranslationUnitCursor(unit), visit_top, NULL);
    write_edited(to);
    clang_disposeTranslationUnit(unit);
    free(source);
}

int main(int count, char **args)
{
    CXIndex index = clang_createIndex(0, 0);
    FILE *list;

    if (count < 5 || count % 2 == 0) {
        fprintf(stderr, "usage: mutate LIST ROOMS IN.i OUT.c [IN.i OUT.c]...\n");
        return 2;
    }
    rooms = args[2];
    for (int i = 3; i < count; i += 2) {
        mutate(index, args[i], args[i + 1]);
    }
    list = fopen(args[1], "w");
    if (list == NULL) {
        fail("cannot write", args[1]);
    }
    for (unsigned i = 0; i < mutant_count; i++) {
        fprintf(list, "%u\t%u\t%u\t%s\n", i + 1, mutants[i].function, mutants[i].line,
                mutants[i].key);
    }
    if (fclose(list) != 0) {
        fail("cannot write", args[1]);
    }
    clang_disposeIndex(index);
    return 0;
}
