/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/html.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "tools/cli/input.h"
#include "tools/cli/json_memory.h"
#include "tools/view/html_data.h"

static const char *const libraries[] = {THREEJSDIR "/build/three.min.js",
                                        THREEJSDIR "/examples/js/controls/OrbitControls.js"};

/* Returns the first library that is missing, or NULL. */
static const char *missing_library(void)
{
    for (int k = 0; k < 2; ++k)
        if (access(libraries[k], R_OK) != 0) return libraries[k];
    return NULL;
}

bool html_is_available(void) { return missing_library() == NULL; }

exit_status html_check(const char *path, const char *verb)
{
    const char *missing = missing_library();
    if (missing == NULL) return EXIT_ANSWERED;
    return complain(EXIT_USAGE, verb,
                    "'%s': a page needs three.js, and %s is not there; install libjs-three, or "
                    "configure --with-threejs=DIR and build again",
                    path, missing);
}

static exit_status read_file(const char *path, const char *verb, input_text *text)
{
    FILE *file = input_open(path, verb);
    if (file == NULL) return EXIT_DATA;
    const bool read = input_read(file, path, verb, text);
    input_close(file);
    return read ? EXIT_ANSWERED : EXIT_DATA;
}

/* Writes a script into a page. Where its text would end the element, or begin a comment that hides
 * that end, a character is escaped, which has the same meaning in a string and in a regular
 * expression. */
static void put_script(const char *text, size_t length, FILE *file)
{
    static const char *const words[] = {"</script", "<!--"};
    for (size_t k = 0; k < length; ++k) {
        bool ends = false;
        for (size_t w = 0; w < 2; ++w)
            ends |= length - k >= strlen(words[w]) &&
                    strncasecmp(text + k, words[w], strlen(words[w])) == 0;
        fputc(text[k], file);
        if (ends) fputc('\\', file);
    }
}

static exit_status put_library(int index, FILE *file, const char *verb)
{
    input_text text = {0};
    const exit_status status = read_file(libraries[index], verb, &text);
    if (status == EXIT_ANSWERED) put_script(text.text, text.length, file);
    free(text.text);
    return status;
}

/* In JSON '<' occurs in strings only, where it can be written as \u003c: then no name can end the
 * element. */
static exit_status put_data(const html_page *page, FILE *file, const char *verb)
{
    json_t *data = html_data(page);
    char *text = json_memory_text(data, JSON_COMPACT | JSON_REAL_PRECISION(17));
    for (const char *c = text; c != NULL && *c != '\0'; ++c) {
        if (*c == '<')
            fputs("\\u003c", file);
        else
            fputc(*c, file);
    }
    json_decref(data);
    const bool good = text != NULL;
    free(text);
    return good ? EXIT_ANSWERED : complain_of_memory(verb);
}

static void put_title(const char *title, FILE *file)
{
    for (; *title != '\0'; ++title) {
        const char *entity = *title == '<' ? "&lt;" : *title == '&' ? "&amp;" : NULL;
        if (entity != NULL)
            fputs(entity, file);
        else
            fputc(*title, file);
    }
}

typedef enum word { WORD_TITLE, WORD_THREE, WORD_ORBIT, WORD_DATA, WORDS } word;

static exit_status put_word(word w, const html_page *page, FILE *file, const char *verb)
{
    switch (w) {
    case WORD_TITLE:
        put_title(page->title, file);
        return EXIT_ANSWERED;
    case WORD_THREE:
        return put_library(0, file, verb);
    case WORD_ORBIT:
        return put_library(1, file, verb);
    case WORD_DATA:
    case WORDS:
        break;
    }
    return put_data(page, file, verb);
}

/* Writes the template with each @WORD@ replaced. */
static exit_status put_page(const char *template, const html_page *page, FILE *file,
                            const char *verb)
{
    static const char *const words[WORDS] = {"@TITLE@", "@THREE@", "@ORBIT@", "@DATA@"};
    exit_status status = EXIT_ANSWERED;
    for (word w = WORD_TITLE; w < WORDS && status == EXIT_ANSWERED; ++w) {
        const char *at = strstr(template, words[w]);
        if (at == NULL) return complain(EXIT_DATA, verb, "page.html: %s is missing", words[w]);
        fwrite(template, 1, (size_t)(at - template), file);
        status = put_word(w, page, file, verb);
        template = at + strlen(words[w]);
    }
    fputs(template, file);
    return status;
}

exit_status html_write(const html_page *page, FILE *file, const char *verb)
{
    input_text text = {0};
    char *path = input_package_file("page.html", verb), *template = NULL;
    exit_status status = path != NULL ? read_file(path, verb, &text) : EXIT_DATA;
    if (status == EXIT_ANSWERED) {
        template = strndup(text.text, text.length);
        status = template != NULL ? put_page(template, page, file, verb) : complain_of_memory(verb);
    }
    free(template);
    free(text.text);
    free(path);
    return status;
}
