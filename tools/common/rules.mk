# SPDX-License-Identifier: MIT
# `make install`: the programs, and the manual pages and bash completions that they print of themselves.
INSTALLED := fistab drive bound
ROOT      := $(DESTDIR)$(PREFIX)
.PHONY: install uninstall
install: $(INSTALLED:%=build/%) build/canary.ihx
	$(Q)install -d $(addprefix $(ROOT)/,bin lib/fuzzy51 share/man/man1 share/bash-completion/completions)
	$(Q)install -m 644 build/canary.ihx $(ROOT)/lib/fuzzy51/
	$(Q)for tool in $(INSTALLED); do \
	    install -m 755 build/$$tool $(ROOT)/lib/fuzzy51/; \
	    ln -sf ../lib/fuzzy51/$$tool $(ROOT)/bin/$$tool; \
	    build/$$tool --man >$(ROOT)/share/man/man1/$$tool.1; \
	    build/$$tool --completion >$(ROOT)/share/bash-completion/completions/$$tool; \
	done
	@echo "installed $(INSTALLED) in $(ROOT)/bin"
uninstall:
	$(Q)rm -rf $(ROOT)/lib/fuzzy51
	$(Q)rm -f $(foreach tool,$(INSTALLED),$(addprefix $(ROOT)/,bin/$(tool) share/man/man1/$(tool).1 share/bash-completion/completions/$(tool)))
