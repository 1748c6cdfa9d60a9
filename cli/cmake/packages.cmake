# Packages of the installed program, made by CPack in a build folder: `cpack -G DEB` makes a package for
# the Debian that built it, `cpack -G TGZ` an archive that runs from wherever it is unpacked, with the
# libraries of the same Debian. `cpack` makes both.
set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_NAME skybake)
set(CPACK_PACKAGE_VENDOR "the skybake authors")
set(CPACK_PACKAGE_CONTACT "The skybake authors <skybake@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "bakes sky tables, cloud noise and cloud volumes")
set(CPACK_PACKAGE_DESCRIPTION
"skybake reads the description of an atmosphere, of noises or of clouds from a
small TOML file and writes EXR, VDB and other files that any runtime can load:
transmittance, multiple scattering, sky views, phase functions, tileable noise,
cloud volumes and the grids with which a ray march skips empty space. Each file
comes with its error, and with the time that it took.")
set(CPACK_STRIP_FILES ON)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/finish_package.cmake)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Pages and charts are set in this font.
set(CPACK_DEBIAN_PACKAGE_DEPENDS fonts-dejavu-core)
# Caches on servers of https:// need them.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS ca-certificates)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
include(CPack)
