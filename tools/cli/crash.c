/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/crash.h"

#include <dlfcn.h>
#include <execinfo.h>
#include <impinge/impinge.h>
#include <link.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "tools/cli/message.h"
#include "tools/cli/standard_output.h"

/* The prepared process: copies made by fork are not watched. */
static pid_t prepared;
static bool json_wanted;

_Noreturn static void leave(int status)
{
    for (;;) syscall(SYS_exit_group, status);
}

/* --- What is said; only calls that are safe in a signal handler ------------------------------- */

typedef struct line {
    char text[1 << 13];
    size_t used;
} line;

static void add(line *l, const char *text)
{
    const size_t length = strlen(text), room = sizeof l->text - 2 - l->used;
    const size_t part = length < room ? length : room;
    memcpy(l->text + l->used, text, part);
    l->used += part;
}

static void add_shown(line *l, const char *text) { add(l, message_shown(text).text); }

/* Adds text to a JSON string. Precondition: it has no control characters. */
static void add_escaped(line *l, const char *text)
{
    for (; *text != '\0'; ++text) {
        if (*text == '"' || *text == '\\') add(l, "\\");
        add(l, (const char[2]){*text, '\0'});
    }
}

static void say(line *l)
{
    add(l, "\n");
    const ssize_t written = write(STDERR_FILENO, l->text, l->used);
    (void)written;
}

_Noreturn void crash_end_with(const char *what, int status)
{
    line text = {.used = 0}, object = {.used = 0};
    add(&text, "impinge: ");
    add(&text, what);
    say(&text);
    if (json_wanted) {
        add(&object, "{\"error\":\"");
        add_escaped(&object, what);
        add(&object, "\"}\n");
        standard_output_write_at_crash(object.text, object.used);
    }
    leave(status);
}

_Noreturn static void end_with(const line *what) { crash_end_with(what->text, EXIT_PLUGIN); }

/* --- Whose fault it is ------------------------------------------------------------------------ */

/* Whether the type is a path: used in place of a type while a plugin is loaded or unloaded. */
static bool is_path(const char *type) { return type[0] == '/'; }

static const char cure_of_loading[] = "; `impinge why FILE` loads it in a process of its own";

/* Adds "PLACE of type 'TYPE'", or of a plugin. */
static void add_place(line *l, const char *type, const char *callback)
{
    add(l, callback);
    add(l, is_path(type) ? " of plugin '" : " of type '");
    add_shown(l, type);
    add(l, "'");
}

/* Reports a crash in a callback; another plugin may have damaged the callback's data. */
_Noreturn static void blame_for_crash(const char *type, const char *callback)
{
    line l = {.used = 0};
    add(&l, "crashed in the ");
    add_place(&l, type, callback);
    add(&l, is_path(type) ? cure_of_loading
                          : "; another plugin may have damaged memory: run with --isolate all, or "
                            "under valgrind; `impinge check` shows more");
    end_with(&l);
}

_Noreturn static void blame_for_end(const char *type, const char *callback, const char *what)
{
    line l = {.used = 0};
    add(&l, is_path(type) ? "plugin '" : "type '");
    add_shown(&l, type);
    add(&l, "' ");
    add(&l, what);
    add(&l, " in its ");
    add(&l, callback);
    add(&l, is_path(type) ? cure_of_loading
                          : "; `impinge check` shows more, --isolate runs it in another process");
    end_with(&l);
}

/* Reports the callback that is running, if any. `what` NULL: a crash. */
static void blame_if_in_call(const char *what)
{
    const char *callback, *type = imp_call_in_progress(&callback);
    if (type == NULL || prepared != getpid()) return;
    if (what == NULL) blame_for_crash(type, callback);
    blame_for_end(type, callback, what);
}

/* The program and the libraries it was started with, which come first in the linker's list. */
static struct {
    const struct link_map *first;
    size_t count;
} started_with;

static void note_objects(void)
{
    started_with.first = dlopen(NULL, RTLD_LAZY);
    for (const struct link_map *o = started_with.first; o != NULL; o = o->l_next)
        started_with.count += 1;
}

/* Returns the file of the plugin, or of a library of one, whose code is at that address; or
 * NULL. */
static const char *plugin_at(void *address)
{
    Dl_info info;
    struct link_map *object = NULL;
    if (dladdr1(address, &info, (void **)&object, RTLD_DL_LINKMAP) == 0 || object == NULL)
        return NULL;
    const struct link_map *o = started_with.first;
    for (size_t k = 0; k < started_with.count && o != NULL; ++k, o = o->l_next)
        if (o == object) return NULL;
    return info.dli_fname;
}

_Noreturn static void blame_unloaded_code(void)
{
    line l = {.used = 0};
    add(&l, "crashed in code that is no longer loaded, as in a thread that a plugin left; run with "
            "--isolate all");
    end_with(&l);
}

/* Code of a plugin also runs outside of its callbacks: in threads that it has left, in destructors
 * of thread-local data, in handlers. Reading the stack is not safe in a handler, but the process is
 * lost anyway; if it hangs, the alarm ends it. */
static void blame_if_on_stack(const void *fault)
{
    enum { FRAMES = 64, SECONDS = 5 };
    void *frame[FRAMES];
    if (prepared != getpid()) return;
    signal(SIGALRM, SIG_DFL);
    alarm(SECONDS);
    const int count = backtrace(frame, FRAMES);
    for (int k = 0; k < count; ++k) {
        Dl_info info;
        const char *file = plugin_at(frame[k]);
        if (fault != NULL && frame[k] == fault && dladdr(fault, &info) == 0) blame_unloaded_code();
        if (file == NULL) continue;
        line l = {.used = 0};
        add(&l, "crashed in plugin '");
        add_shown(&l, file);
        add(&l, "' outside of its callbacks, as in a thread that it left; run with --isolate all");
        end_with(&l);
    }
}

/* Older unwinders crash where the stack begins in code that is no longer loaded; newer ones end
 * there, with the address of the fault. */
static void on_second_crash(int number)
{
    (void)number;
    blame_unloaded_code();
}

static void on_crash(int number, siginfo_t *about, void *context)
{
    (void)context;
    blame_if_in_call(NULL);
    signal(SIGSEGV, on_second_crash);
    signal(SIGBUS, on_second_crash);
    blame_if_on_stack(number == SIGSEGV || number == SIGBUS ? about->si_addr : NULL);
    if (prepared == getpid()) {
        line l = {.used = 0};
        add(&l, "impinge: crashed outside of all plugins; if one has damaged memory, --isolate all "
                "or valgrind shows which");
        say(&l);
    }
    signal(number, SIG_DFL);
    raise(number);
}

/* --- Threads and their calls ------------------------------------------------------------------ */

/* The main thread and as many as --threads allows; calls of further threads are not recorded. */
enum { THREADS_MAX = 1025 };

/* The current call of each thread; NULL: a free slot. */
static const imp_call *_Atomic calls[THREADS_MAX];
static _Thread_local size_t own_call = THREADS_MAX;

/* Set when a handler begins to read them, for good: it ends the process. */
static atomic_bool calls_are_read;

static void enter_call(void)
{
    for (own_call = 0; own_call < THREADS_MAX; ++own_call) {
        const imp_call *free_place = NULL;
        if (atomic_compare_exchange_strong(&calls[own_call], &free_place, imp_call_of_thread()))
            return;
    }
}

/* Removes an ending thread's call; waits if the handler may be reading it. */
static void leave_call(void)
{
    if (own_call == THREADS_MAX) return;
    atomic_store(&calls[own_call], NULL);
    while (atomic_load(&calls_are_read)) pause();
}

static void say_interrupted(const char *type, const char *callback)
{
    line l = {.used = 0};
    add(&l, "impinge: interrupted in ");
    add_place(&l, type, callback);
    if (!is_path(type)) add(&l, "; where a callback hangs, --isolate ends it after 5 s");
    say(&l);
}

void crash_interrupted(int number)
{
    if (prepared == getpid()) atomic_store(&calls_are_read, true);
    for (size_t k = 0; k < THREADS_MAX && prepared == getpid(); ++k) {
        const imp_call *call = atomic_load(&calls[k]);
        const char *callback, *type = imp_call_read(call, &callback);
        if (type != NULL) say_interrupted(type, callback);
    }
    signal(number, SIG_DFL);
    raise(number);
}

static void on_exit_in_call(void) { blame_if_in_call("ends the process"); }
static void on_fork_in_call(void) { blame_if_in_call("forks the process"); }

/* The program's symbols come before those of libc, so a plugin that leaves by _exit, which runs no
 * handler, leaves by these. */
__attribute__((visibility("default"))) void _exit(int status)
{
    if (prepared != 0) on_exit_in_call();
    leave(status);
}

__attribute__((visibility("default"))) void _Exit(int status) { _exit(status); }

enum { SIGNAL_STACK = 1 << 16 };

void *crash_thread_begin(void)
{
    void *room = malloc(SIGNAL_STACK);
    const stack_t stack = {.ss_sp = room, .ss_size = SIGNAL_STACK};
    if (room != NULL) sigaltstack(&stack, NULL);
    enter_call();
    return room;
}

void crash_thread_end(void *stack)
{
    const stack_t none = {.ss_flags = SS_DISABLE};
    leave_call();
    sigaltstack(&none, NULL);
    free(stack);
}

void crash_thread_left(void *unused)
{
    (void)unused;
    on_exit_in_call();
}

/* Handlers run on a separate stack: a plugin may have exhausted the other. */
void crash_prepare(bool json)
{
    static char room[SIGNAL_STACK];
    const stack_t stack = {.ss_sp = room, .ss_size = sizeof room};
    struct sigaction action = {.sa_sigaction = on_crash,
                               .sa_flags = SA_ONSTACK | SA_NODEFER | SA_SIGINFO};
    void *frame;
    prepared = getpid();
    json_wanted = json;
    backtrace(&frame, 1); /* loads the unwinder, which is then not taken for a plugin's library */
    note_objects();
    enter_call();
    sigemptyset(&action.sa_mask);
    sigaltstack(&stack, NULL);
    const int fatal[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
    for (size_t k = 0; k < sizeof fatal / sizeof *fatal; ++k) sigaction(fatal[k], &action, NULL);
    action.sa_flags &= ~SA_SIGINFO;
    action.sa_handler = crash_interrupted;
    struct sigaction usual;
    if (sigaction(SIGQUIT, NULL, &usual) == 0 && usual.sa_handler != SIG_IGN)
        sigaction(SIGQUIT, &action, NULL);
    atexit(on_exit_in_call);
    at_quick_exit(on_exit_in_call);
    pthread_atfork(on_fork_in_call, NULL, NULL);
}
