# CPack runs this before it makes a package of what was installed. Debian's packages have compressed
# manual pages, and a copyright and a changelog in /usr/share/doc.
if(NOT CPACK_GENERATOR STREQUAL DEB)
    return()
endif()
set(share ${CPACK_TEMPORARY_DIRECTORY}/usr/share)
set(document ${share}/doc/skybake)
file(RENAME ${document}/LICENSE ${document}/copyright)
file(WRITE ${document}/changelog
"skybake (${CPACK_PACKAGE_VERSION}) bookworm; urgency=medium

  * Its versions are those of its repository.

 -- ${CPACK_PACKAGE_CONTACT}  Sun, 01 Nov 2026 00:00:00 +0000
")
file(GLOB pages ${share}/man/man1/*.1)
# -n leaves times out, so that the same build makes the same bytes.
execute_process(COMMAND gzip -9n ${pages} ${document}/changelog COMMAND_ERROR_IS_FATAL ANY)
