// Tests the allocation of aligned memory: its alignment, and sizes that no memory has.
#include "renderer/base/pages.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static void blocks_are_aligned_and_can_be_written(void **state) {
    (void)state;
    static const size_t sizes[] = {0, 1, 64, 65, (1 << 20) - 1, 1 << 20, (2 << 20) + 1};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        void *lines = dip_lines_alloc(sizes[i]);
        void *pages = dip_pages_alloc(sizes[i]);
        assert_non_null(lines);
        assert_non_null(pages);
        assert_int_equal((uintptr_t)lines % DIP_CACHE_LINE, 0);
        assert_int_equal((uintptr_t)pages % DIP_CACHE_LINE, 0);
        memset(lines, 1, sizes[i]);
        memset(pages, 1, sizes[i]);
        dip_lines_free(lines);
        dip_lines_free(pages);
    }
    dip_lines_free(NULL);
}

// A size that is rounded up to whole lines or pages must not wrap to a small one.
static void sizes_that_cannot_be_rounded_up_are_out_of_memory(void **state) {
    (void)state;
    for (size_t i = 0; i < DIP_CACHE_LINE; i++) {
        assert_null(dip_lines_alloc(SIZE_MAX - i));
        assert_null(dip_pages_alloc(SIZE_MAX - i));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_are_aligned_and_can_be_written),
        cmocka_unit_test(sizes_that_cannot_be_rounded_up_are_out_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
