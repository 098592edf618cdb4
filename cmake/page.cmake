# The report page's style and script, which is one file made of reports/page/browser and three.js. A
# page without script is made where the npm packages are missing.

set(folder ${PROJECT_BINARY_DIR}/page)
set(bundler ${PROJECT_SOURCE_DIR}/third_party/node_modules/esbuild/bin/esbuild)
file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/reports/page/browser/*.js)
set(style ${PROJECT_SOURCE_DIR}/reports/page/page.css)

if(EXISTS ${bundler} AND EXISTS ${PROJECT_SOURCE_DIR}/third_party/node_modules/three)
  add_custom_command(
    OUTPUT ${folder}/page.js
    COMMAND ${CMAKE_COMMAND} -E env NODE_PATH=${PROJECT_SOURCE_DIR}/third_party/node_modules
      ${bundler} ${PROJECT_SOURCE_DIR}/reports/page/browser/main.js
      --bundle --minify --format=iife --target=es2022 --legal-comments=eof --log-level=warning
      --outfile=${folder}/page.js
    DEPENDS ${sources} ${PROJECT_SOURCE_DIR}/third_party/package.json
    COMMENT "Bundling the script of the report page"
    VERBATIM)
  set(script ${folder}/page.js)
else()
  message(STATUS "No esbuild or three.js (scripts/install.sh brings them): reports will have no viewer")
  set(script)
endif()

add_custom_command(
  OUTPUT ${folder}/page.css
  COMMAND ${CMAKE_COMMAND} -E copy ${style} ${folder}/page.css
  DEPENDS ${style}
  VERBATIM)
add_custom_target(fracbench_page DEPENDS ${folder}/page.css ${script})
add_dependencies(fracbench_reports fracbench_page)
fracbench_path_for(reports/page/write_page.cpp FRACBENCH_PAGE_FOLDER ${folder})
