# Run by CPack on each component's tree: copyright and a changelog in Debian's form in /usr/share/doc/PACKAGE; the
# licence is one of those that every Debian has.
file(GLOB trees ${CPACK_TEMPORARY_DIRECTORY}/*)
foreach(tree ${trees})
  get_filename_component(component ${tree} NAME)
  set(package st)
  if(component STREQUAL dev)
    set(package st-dev)
  endif()
  set(doc ${tree}/usr/share/doc/${package})
  file(MAKE_DIRECTORY ${doc})
  file(COPY_FILE ${CPACK_ST_SOURCE_DIR}/packaging/copyright ${doc}/copyright)
  set(date "%a, %d %b %Y %H:%M:%S +0000")
  string(TIMESTAMP date "${date}" UTC)  # of SOURCE_DATE_EPOCH where that is set
  file(WRITE ${tree}/changelog "${package} (${CPACK_ST_VERSION}) unstable; urgency=medium\n\n"
       "  * See /usr/share/doc/st/CHANGELOG.md.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  execute_process(COMMAND gzip -9nc ${tree}/changelog OUTPUT_FILE ${doc}/changelog.gz)
  file(REMOVE ${tree}/changelog ${doc}/LICENSE)
endforeach()
