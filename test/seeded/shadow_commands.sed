# In shadow the app commands all the same.
# file: src/firmware/controller.c
# test: app_
s/if (GLUE\.stock_share > 0\.0f) {/if (GLUE.stock_share > 2.0f) {/
