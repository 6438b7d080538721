# What every target of the ladder shares: warning flags, and add_rung() for one tutorial's program, which tests then
# find in the list GLL_RUNGS.

add_library(gll_warnings INTERFACE)
target_compile_options(gll_warnings INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion $<$<BOOL:${GLLADDER_WERROR}>:-Werror>)

# add_rung(NN_name SOURCE...): the executable of one rung, from files beside the caller's CMakeLists.txt. Its name joins
# the global property GLL_RUNGS: whatever is done with every rung goes through that list.
function(add_rung name)
    add_executable(${name} ${ARGN})
    target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR}/tutorials) # a lower rung's technique: "01_hdr/..."
    target_link_libraries(${name} PRIVATE gll_run gll_warnings)
    set_property(GLOBAL APPEND PROPERTY GLL_RUNGS ${name})
endfunction()
