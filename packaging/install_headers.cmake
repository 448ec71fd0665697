# Installs the planner's headers, and those of ours that they include, in include/gnbv. What stands
# in our sources as "planner/onboard.hpp" is "gnbv/planner/onboard.hpp" for others. Headers of the
# SIMD loops, which only our own sources compile, stay here.
cmake_path(GET CMAKE_CURRENT_LIST_DIR PARENT_PATH root)
file(GLOB_RECURSE headers RELATIVE ${root} ${root}/planner/*.hpp)
list(FILTER headers EXCLUDE REGEX "_(loops|kernels)\\.hpp$")
while(headers)
  list(POP_FRONT headers header)
  file(READ ${root}/${header} text)
  string(REGEX MATCHALL "#include \"[^\"]+" included "${text}")
  list(TRANSFORM included REPLACE "#include \"" "")
  list(APPEND installed ${header})
  list(REMOVE_ITEM included ${installed})
  list(APPEND headers ${included})
  list(REMOVE_DUPLICATES headers)
  string(REPLACE "#include \"" "#include \"gnbv/" text "${text}")
  file(WRITE $ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/include/gnbv/${header} "${text}")
endwhile()
