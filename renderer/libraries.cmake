# How the renderer's libraries are built and installed.
#
# Every library is built twice from the same objects: dip_<name>, static, which the program links,
# and dip_<name>_shared, which exports only what the public headers mark with DIP_API. A library
# that calls a private function of another one therefore fails to link.

include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(DIP_INCLUDE_DIR ${CMAKE_INSTALL_INCLUDEDIR}/diptych)

# dip_add_library(<name> SOURCES <files> [LINKS <names of dip libraries>] [PRIVATE <targets>])
# makes dip_<name>, dip_<name>_shared and the objects dip_<name>_objects behind both.
function(dip_add_library name)
    cmake_parse_arguments(L "" "" "SOURCES;LINKS;PRIVATE" ${ARGN})
    set(objects dip_${name}_objects)
    add_library(${objects} OBJECT ${L_SOURCES})
    target_link_libraries(${objects} PUBLIC dip_options ${L_PRIVATE})
    add_library(dip_${name} STATIC $<TARGET_OBJECTS:${objects}>)
    add_library(dip_${name}_shared SHARED $<TARGET_OBJECTS:${objects}>)
    foreach(kind "" "_shared")
        set(target dip_${name}${kind})
        target_include_directories(${target} PUBLIC
            $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}> $<INSTALL_INTERFACE:${DIP_INCLUDE_DIR}>)
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
    set_property(TARGET installed APPEND PROPERTY DIP_FILES
        $<TARGET_FILE:dip_${name}> $<TARGET_FILE:dip_${name}_shared>)
    set_property(GLOBAL APPEND PROPERTY DIP_LIBRARIES ${name})
    set_property(GLOBAL PROPERTY DIP_LINKS_${name} ${L_LINKS})
endfunction()

# dip_add_objects(<name> <object target>): adds further objects to both forms of dip_<name>.
function(dip_add_objects name objects)
    target_sources(dip_${name} PRIVATE $<TARGET_OBJECTS:${objects}>)
    target_sources(dip_${name}_shared PRIVATE $<TARGET_OBJECTS:${objects}>)
endfunction()

# dip_install_libraries(): installs headers, libraries, a CMake package and pkg-config files.
function(dip_install_libraries)
    get_property(names GLOBAL PROPERTY DIP_LIBRARIES)
    # pkg-config files find the other files from their own place, so that an installed copy can be
    # moved and --prefix may choose its folder.
    file(RELATIVE_PATH DIP_PC_PREFIX ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
    string(REGEX REPLACE "/$" "" DIP_PC_PREFIX ${DIP_PC_PREFIX})
    foreach(name IN LISTS names)
        install(TARGETS dip_${name} dip_${name}_shared EXPORT diptych
            COMPONENT development)
        file(GLOB headers CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/renderer/${name}/*.h)
        install(FILES ${headers} DESTINATION ${DIP_INCLUDE_DIR}/renderer/${name}
            COMPONENT development)
        get_property(links GLOBAL PROPERTY DIP_LINKS_${name})
        list(TRANSFORM links PREPEND diptych- OUTPUT_VARIABLE DIP_PC_REQUIRES)
        string(REPLACE ";" " " DIP_PC_REQUIRES "${DIP_PC_REQUIRES}")
        set(DIP_PC_NAME ${name})
        configure_file(${CMAKE_SOURCE_DIR}/renderer/diptych.pc.in
            ${CMAKE_BINARY_DIR}/diptych-${name}.pc @ONLY)
        install(FILES ${CMAKE_BINARY_DIR}/diptych-${name}.pc
            DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
    endforeach()
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
