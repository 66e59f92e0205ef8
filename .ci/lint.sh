# ./test long: clang-tidy with the checks of .clang-tidy, and cppcheck, over the code that users
# get. ./test sources this file. Each line of cppcheck.txt is a fault that cppcheck tells wrongly.

CHECKED_FOLDERS="renderer assets campaths config app"

# check_code: needs the build with clang, whose commands clang-tidy understands.
check_code() {
    echo "== clang-tidy" >&2
    build release-clang
    pattern="^$TOP/($(echo $CHECKED_FOLDERS | tr ' ' '|'))/"
    run-clang-tidy -quiet -p build/release-clang "$pattern" >build/clang-tidy.log 2>&1 || {
        grep -E '(warning|error):|^ ' build/clang-tidy.log >&2
        return 1
    }
    echo "== cppcheck" >&2
    # A kernel is checked as it is compiled for SSE2.
    cppcheck --quiet --error-exitcode=1 --std=c11 -j "$(nproc)" -I . \
        --enable=warning,performance,portability --inline-suppr \
        --suppressions-list=.ci/cppcheck.txt --library=posix \
        -D__SSE2__=1 -DDIP_LANES=4 -DDIP_ISA_SUFFIX=sse2 -DDIP_EXPECT_SSE2=1 $CHECKED_FOLDERS
}
