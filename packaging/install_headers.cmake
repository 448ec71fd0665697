# Installs the headers of the planner's library, and those of ours that they include, in
# include/gnbv. What our sources call "planner/onboard.hpp" is "gnbv/planner/onboard.hpp" for others.
cmake_path(GET CMAKE_CURRENT_LIST_DIR PARENT_PATH root)
set(headers planner/onboard.hpp planner/planners.hpp planner/map/octomap_io.hpp
  planner/symmetry/symmetry.hpp planner/view/visibility.hpp)
while(headers)
  list(POP_FRONT headers header)
  list(APPEND installed ${header})
  file(READ ${root}/${header} text)
  string(REGEX MATCHALL "#include \"[^\"]+" included "${text}")
  list(TRANSFORM included REPLACE "#include \"" "")
  list(REMOVE_ITEM included ${installed})
  list(APPEND headers ${included})
  list(REMOVE_DUPLICATES headers)
  string(REPLACE "#include \"" "#include \"gnbv/" text "${text}")
  file(WRITE $ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/include/gnbv/${header} "${text}")
endwhile()
