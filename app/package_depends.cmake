# CPack runs this script before it makes a package. The script asks dpkg-shlibdeps which packages the
# program needs. CPack's own way, CPACK_DEBIAN_PACKAGE_SHLIBDEPS, starts two programs for each of the
# package's files to find those that dpkg-shlibdeps can read; here there is one.
if(CPACK_GENERATOR STREQUAL "DEB")
    set(program "${CPACK_TEMPORARY_INSTALL_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX}/bin/diptych")
    file(WRITE ${CPACK_TEMPORARY_DIRECTORY}/debian/control "") # dpkg-shlibdeps does not run without it.
    execute_process(COMMAND dpkg-shlibdeps --ignore-missing-info -O "${program}"
        WORKING_DIRECTORY "${CPACK_TEMPORARY_DIRECTORY}"
        OUTPUT_VARIABLE found ERROR_VARIABLE said RESULT_VARIABLE result
        OUTPUT_STRIP_TRAILING_WHITESPACE)
    file(REMOVE_RECURSE "${CPACK_TEMPORARY_DIRECTORY}/debian")
    if(NOT result EQUAL 0 OR NOT found MATCHES "^shlibs:Depends=(.+)$")
        message(FATAL_ERROR "dpkg-shlibdeps does not tell what ${program} needs: ${said}")
    endif()
    string(PREPEND CPACK_DEBIAN_PACKAGE_DEPENDS "${CMAKE_MATCH_1}, ")
endif()
