# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# Manual pages: those of the C API are written from the headers, whenever one changes.

dist_man_MANS += \
    tools/manual/impinge-scene.5 \
    tools/manual/impinge.7 \
    tools/manual/impinge-plugin.7
EXTRA_DIST += tools/manual/header_pages.awk

man3dir = $(mandir)/man3
header_pages = tools/manual/man3/libimpinge.3
noinst_DATA += $(header_pages)
$(header_pages): tools/manual/header_pages.awk $(core_include_HEADERS)
	$(AM_V_GEN)rm -rf $(@D) && $(MKDIR_P) $(@D) && \
	  $(AWK) -v to=$(@D) -v version='$(PACKAGE_VERSION)' \
	    -f $(srcdir)/tools/manual/header_pages.awk $(core_include_HEADERS:%=$(srcdir)/%) && \
	  touch $@
.PHONY: install-header-pages uninstall-header-pages clean-header-pages clean-manuals
install-header-pages: $(header_pages)
	$(MKDIR_P) "$(DESTDIR)$(man3dir)" && \
	  $(INSTALL_DATA) tools/manual/man3/*.3 "$(DESTDIR)$(man3dir)"
uninstall-header-pages: $(header_pages)
	cd tools/manual/man3 && for page in *.3; do rm -f "$(DESTDIR)$(man3dir)/$$page"; done
clean-header-pages:
	rm -rf tools/manual/man3

# The tutorial, whose commands are run, and whose pictures are drawn, by the command just built.
dist_doc_DATA += tools/manual/tutorial.md
EXTRA_DIST += tools/manual/html tools/manual/walk_tutorial
tutorial_environment = \
    PATH="$(abs_top_builddir)/tools/manual/bin:$(abs_top_builddir)/tools:$$PATH" \
    IMPINGE_PLUGIN_PATH='$(abs_top_builddir)/plugins/.libs' \
    IMPINGE_LIBRARY='$(abs_top_builddir)/.libs/libimpinge.so' \
    PYTHONPATH='$(abs_top_srcdir)/sdk/python' PYTHONDONTWRITEBYTECODE=1
tools/manual/tutorial/done: tools/manual/tutorial.md tools/manual/walk_tutorial all-am
	$(AM_V_GEN)rm -rf $(@D) && $(MKDIR_P) tools/manual/bin && \
	  { test '$(PYTHON3)' = no || \
	    ln -sf "$$(command -v $(PYTHON3))" tools/manual/bin/python3; } && $(tutorial_environment) \
	  $(srcdir)/tools/manual/walk_tutorial $(srcdir)/tools/manual/tutorial.md $(@D) >$(@D).log || \
	  { tail -n 20 $(@D).log; exit 1; }
	@touch $@

# All manuals as pages for a browser, in the folder html.
html_documents = README.md tools/manual/tutorial.md sdk/README NEWS
html-local: $(header_pages) tools/manual/tutorial/done
	$(AM_V_GEN)$(srcdir)/tools/manual/html html $(html_documents:%=$(srcdir)/%) \
	  $(dist_man_MANS:%=$(srcdir)/%) tools/manual/man3/*.3 \
	  tools/manual/tutorial/*.png $(srcdir)/tools/data/*.png
	@echo 'html/index.html leads to all manuals'
clean-manuals: clean-header-pages
	rm -rf tools/manual/bin tools/manual/tutorial tools/manual/tutorial.log html

# Completions of shells, where these look for them below the prefix.
bashcompletiondir = $(datadir)/bash-completion/completions
zshcompletiondir = $(datadir)/zsh/site-functions
fishcompletiondir = $(datadir)/fish/vendor_completions.d
dist_zshcompletion_DATA = tools/completion/_impinge
dist_fishcompletion_DATA = tools/completion/impinge.fish
nodist_bashcompletion_DATA = tools/completion/impinge
EXTRA_DIST += tools/completion/impinge.bash
CLEANFILES += tools/completion/impinge
tools/completion/impinge: tools/completion/impinge.bash
	$(AM_V_GEN)$(MKDIR_P) $(@D) && cp $< $@ && chmod u+w $@
