# How the libraries for other programs are built and installed.
#
# Every library is built twice from the same objects: dip_<name>, static, which the program links,
# and dip_<name>_shared, which exports only what the public headers mark with DIP_API. A library
# that calls a private function of another one therefore fails to link.

include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(DIP_INCLUDE_DIR ${CMAKE_INSTALL_INCLUDEDIR}/diptych)

# dip_add_library(<name> SOURCES <files> [LINKS <names of dip libraries>] [PRIVATE <targets>]
#     [PKG_CONFIG <packages>] [HEADERS <files>])
# makes dip_<name>, dip_<name>_shared and the objects dip_<name>_objects behind both. PKG_CONFIG:
# the packages of the PRIVATE targets that pkg_check_modules has made. HEADERS: the public headers;
# all headers of the folder unless they are given.
function(dip_add_library name)
    cmake_parse_arguments(L "" "" "SOURCES;LINKS;PRIVATE;PKG_CONFIG;HEADERS" ${ARGN})
    set(objects dip_${name}_objects)
    add_library(${objects} OBJECT ${L_SOURCES})
    target_link_libraries(${objects} PUBLIC dip_options ${L_PRIVATE})
    add_library(dip_${name} STATIC $<TARGET_OBJECTS:${objects}>)
    add_library(dip_${name}_shared SHARED $<TARGET_OBJECTS:${objects}>)
    foreach(kind "" "_shared")
        set(target dip_${name}${kind})
        target_include_directories(${target} PUBLIC
            $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
        target_link_libraries(${target} PUBLIC $<BUILD_INTERFACE:dip_options> PRIVATE ${L_PRIVATE} m)
        foreach(link IN LISTS L_LINKS)
            target_link_libraries(${target} PUBLIC dip_${link}${kind})
        endforeach()
        set_target_properties(${target} PROPERTIES
            OUTPUT_NAME diptych-${name} EXPORT_NAME ${name}${kind})
    endforeach()
    set_target_properties(dip_${name}_shared PROPERTIES
        VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
        INSTALL_RPATH "$ORIGIN")
    if(NOT DIP_SANITIZE) # sanitized objects need symbols that only the program defines
        target_link_options(dip_${name}_shared PRIVATE -Wl,-z,defs)
    endif()
    add_dependencies(installed dip_${name} dip_${name}_shared)

    if(NOT L_HEADERS)
        file(GLOB L_HEADERS CONFIGURE_DEPENDS *.h)
    endif()
    cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${CMAKE_SOURCE_DIR}
        OUTPUT_VARIABLE folder)
    dip_install_sources(development ${DIP_INCLUDE_DIR}/${folder} ${L_HEADERS})
    foreach(header IN LISTS L_HEADERS)
        cmake_path(GET header FILENAME header)
        set_property(GLOBAL APPEND PROPERTY DIP_HEADERS ${folder}/${header})
    endforeach()
    install(TARGETS dip_${name} dip_${name}_shared EXPORT diptych COMPONENT development)
    dip_install_pkg_config(${name} "-L\${libdir} -ldiptych-${name}" "${L_LINKS}" "${L_PKG_CONFIG}")
endfunction()

# dip_add_collection(<name> <names of dip libraries>): makes dip_<name> and dip_<name>_shared, which
# stand for several libraries.
function(dip_add_collection name)
    foreach(kind "" "_shared")
        set(links ${ARGN})
        list(TRANSFORM links PREPEND dip_)
        list(TRANSFORM links APPEND "${kind}")
        add_library(dip_${name}${kind} INTERFACE)
        target_link_libraries(dip_${name}${kind} INTERFACE ${links})
        set_target_properties(dip_${name}${kind} PROPERTIES EXPORT_NAME ${name}${kind})
        install(TARGETS dip_${name}${kind} EXPORT diptych COMPONENT development)
    endforeach()
    dip_install_pkg_config(${name} "" "${ARGN}" "")
endfunction()

# dip_add_objects(<name> <object target>): adds further objects to dip_<name>, and to its shared form if it
# has one.
function(dip_add_objects name objects)
    target_sources(dip_${name} PRIVATE $<TARGET_OBJECTS:${objects}>)
    if(TARGET dip_${name}_shared)
        target_sources(dip_${name}_shared PRIVATE $<TARGET_OBJECTS:${objects}>)
    endif()
endfunction()

# dip_install_sources(<component> <folder> <files>): installs sources. In this tree, a header is
# included as "renderer/base/error.h". An installed copy includes the installed header
# <diptych/renderer/base/error.h>, so that it cannot meet a folder renderer/ of another program.
function(dip_install_sources component folder)
    install(FILES ${ARGN} DESTINATION ${folder} COMPONENT ${component})
    set(names "")
    foreach(file IN LISTS ARGN)
        cmake_path(GET file FILENAME name)
        list(APPEND names ${name})
    endforeach()
    install(CODE "
        set(folder [[${folder}]])
        cmake_path(ABSOLUTE_PATH folder BASE_DIRECTORY \"\${CMAKE_INSTALL_PREFIX}\")
        foreach(name IN ITEMS ${names})
            set(file \"\$ENV{DESTDIR}\${folder}/\${name}\")
            file(READ \"\${file}\" text)
            string(REGEX REPLACE
                [[#include \"((renderer|campaths|assets|app/files|app/measure)/[^\"]*)\"]]
                [[#include <diptych/\\1>]] text \"\${text}\")
            file(WRITE \"\${file}\" \"\${text}\")
        endforeach()" COMPONENT ${component})
endfunction()

# dip_install_pkg_config(<name> <linker flags> <names of dip libraries> <packages>): installs the
# file for pkg-config. It finds the other files from its own place, so that an installed copy can be
# moved and --prefix may choose its folder.
function(dip_install_pkg_config name DIP_PC_LIBS links packages)
    file(RELATIVE_PATH DIP_PC_PREFIX ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
    string(REGEX REPLACE "/$" "" DIP_PC_PREFIX ${DIP_PC_PREFIX})
    list(TRANSFORM links PREPEND diptych-)
    list(JOIN links " " DIP_PC_REQUIRES)
    list(JOIN packages " " DIP_PC_REQUIRES_PRIVATE)
    set(DIP_PC_NAME ${name})
    configure_file(${CMAKE_SOURCE_DIR}/renderer/diptych.pc.in
        ${CMAKE_BINARY_DIR}/diptych-${name}.pc @ONLY)
    install(FILES ${CMAKE_BINARY_DIR}/diptych-${name}.pc
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endfunction()

# dip_install_flat_header(): makes and installs diptych.cdef, which has the declarations of all
# public headers (flat_header.cmake).
function(dip_install_flat_header)
    get_property(headers GLOBAL PROPERTY DIP_HEADERS)
    list(REMOVE_ITEM headers renderer/base/fp_mode.h) # It only has inline functions.
    list(TRANSFORM headers PREPEND ${CMAKE_SOURCE_DIR}/ OUTPUT_VARIABLE files)
    list(JOIN headers "," headers)
    set(flat ${CMAKE_BINARY_DIR}/diptych.cdef)
    set(script ${CMAKE_SOURCE_DIR}/renderer/flat_header.cmake)
    add_custom_command(OUTPUT ${flat}
        COMMAND ${CMAKE_COMMAND} -DCOMPILER=${CMAKE_C_COMPILER} -DSOURCE_DIR=${CMAKE_SOURCE_DIR}
            -DHEADERS=${headers} -DFOLDER=${CMAKE_BINARY_DIR}/flat_header -DOUTPUT=${flat}
            -P ${script}
        DEPENDS ${files} ${script}
        VERBATIM)
    add_custom_target(flat_header ALL DEPENDS ${flat})
    add_dependencies(installed flat_header)
    install(FILES ${flat} DESTINATION ${DIP_INCLUDE_DIR} COMPONENT development)
endfunction()

# dip_install_package(): installs the CMake package of all libraries.
function(dip_install_package)
    install(EXPORT diptych NAMESPACE Diptych::
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Diptych COMPONENT development)
    configure_package_config_file(${CMAKE_SOURCE_DIR}/renderer/DiptychConfig.cmake.in
        ${CMAKE_BINARY_DIR}/DiptychConfig.cmake
        INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Diptych)
    write_basic_package_version_file(${CMAKE_BINARY_DIR}/DiptychConfigVersion.cmake
        COMPATIBILITY SameMinorVersion)
    install(FILES ${CMAKE_BINARY_DIR}/DiptychConfig.cmake
        ${CMAKE_BINARY_DIR}/DiptychConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Diptych COMPONENT development)
endfunction()
