# A commit is taken in the tick between its write and the callback that checks it.
# file: src/firmware/settings.c
# test: app_
s/take_commit(GLUE\.commit_asked)/take_commit(GLUE.commit)/; s/if (GLUE\.commit_asked != 0)/if (GLUE.commit != 0)/
