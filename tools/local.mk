# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# The command: main and one file per verb. It sees the public API and nothing else of core.
# When tools/main.c arrives: bin_PROGRAMS += tools/impinge, with these and its own sources.
tool_sources = tools/build_tree.c tools/build_tree.h

EXTRA_DIST += $(tool_sources) tools/demo tools/prepare tools/test
