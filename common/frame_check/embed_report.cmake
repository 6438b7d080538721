# Makes report_page.hpp of the report's parts: one page in one string. Run by the build with SOURCE and OUTPUT.
foreach(part page.html style.css pictures.js viewer.js review.js page.js)
    file(READ ${SOURCE}/${part} ${part})
endforeach()
# A part may hold what looks like a reference to a variable, so that nothing here is configured.
string(REPLACE "@STYLE@" "${style.css}" page "${page.html}")
string(REPLACE "@SCRIPT@" "${pictures.js}${viewer.js}${review.js}${page.js}" page "${page}")
# Compilers take no string of any length: pieces that are joined.
set(text "// Made from report/ by embed_report.cmake.\n#pragma once\n\nnamespace gll::frame_check {\n\ninline constexpr char report_page[] =\n")
string(LENGTH "${page}" length)
set(at 0)
while(at LESS length)
    string(SUBSTRING "${page}" ${at} 8000 piece)
    string(APPEND text "R\"REPORT(${piece})REPORT\"\n")
    math(EXPR at "${at} + 8000")
endwhile()
string(APPEND text ";\n\n} // namespace gll::frame_check\n")
file(WRITE ${OUTPUT} "${text}")
