/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stddef.h>

#include "tools/cli/help_topics.h"

const help_topic help_topics[] = {
    {"pipelines", "How a surface is written on the command line",
     "A surface is a type with its parameters, then any number of maps behind '!':\n"
     "\n"
     "  'torus major_radius=1 minor_radius=.3 ! rotate axis=1,0,0 rate=2'\n"
     "\n"
     "Quotes make it one word. Values are JSON without blanks; 1,0,0 is short for [1,0,0]. What\n"
     "is not given has the default that `impinge info TYPE` shows. Maps are applied from left to\n"
     "right. `impinge list` shows all types and maps.\n"},
    {"scenes", "How a scene file is written",
     "A scene is a JSON object: bodies, each of any number of surfaces under any number of maps.\n"
     "\n"
     "  { \"time\": [0,1], \"gamma\": 1e-6,\n"
     "    \"bodies\": [\n"
     "      {\"name\": \"ball\", \"surfaces\": [{\"type\": \"sphere\", \"radius\": 0.4}],\n"
     "       \"maps\": [{\"type\": \"translate\", \"velocity\": [-2,0,0]}]},\n"
     "      {\"name\": \"ring\", \"surfaces\": [{\"type\": \"torus\", \"center\": [-3,0,0]}]} ] }\n"
     "\n"
     "`man impinge-scene` describes every key, each with an example.\n"},
    {"proof", "What is proved, and what must be believed",
     "For every verdict nothing is nearer than gamma_clear before t_lower. `contact`: the two\n"
     "points lie on their surfaces and are at most gamma apart. `clear`: never nearer than\n"
     "gamma_clear. `undecided`: a limit came first. Between gamma_clear and gamma contact and\n"
     "clear are both right. All of it holds in floating point, given plugins that keep their\n"
     "promises; `impinge check` attacks these, and --audit holds bounds against points.\n"
     "`man 7 impinge` tells more, and has a glossary.\n"},
    {"plugins", "Where types come from, and how to write one",
     "Each type is a plugin, a shared object. They are looked for in --plugin-path, then in the\n"
     "environment's IMPINGE_PLUGIN_PATH, then in ~/.local/share/impinge/1, then where Impinge is\n"
     "installed. `impinge new NAME` begins one, `impinge build FILE` compiles one, `impinge\n"
     "check TYPE` tries to refute it, `impinge why FILE` says what is wrong with a file.\n"
     "`man impinge-plugin` has a complete one.\n"},
    {"completion", "How shells complete command lines",
     "bash (with bash-completion), zsh and fish complete verbs, options and their values, types,\n"
     "parameters and maps: after 'torus they offer major_radius= and minor_radius=. Where\n"
     "Impinge has a prefix of its own, let the shell read the file for it:\n"
     "\n"
     "  bash: . PREFIX/share/bash-completion/completions/impinge      in ~/.bashrc\n"
     "  zsh:  fpath+=(PREFIX/share/zsh/site-functions)                in ~/.zshrc, before "
     "compinit\n"
     "  fish: . PREFIX/share/fish/vendor_completions.d/impinge.fish   in config.fish\n"},
    {NULL, NULL, NULL},
};
