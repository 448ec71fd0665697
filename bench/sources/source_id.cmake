# Writes the SHA-256 over sources and build as a C++ file; run by cmake -P while building.
#   ROOT      of the repository
#   SOURCES   a file with a path a line, relative to ROOT
#   BUILD     what else the program is made of: compiler, flags, libraries
#   FUNCTION  of source_ids.hpp, that is to return it
#   OUTPUT    the file to write
file(STRINGS "${SOURCES}" paths)
list(SORT paths)
set(content "${BUILD}\n")
foreach(path IN LISTS paths)
  file(SHA256 "${ROOT}/${path}" digest)
  string(APPEND content "${path} ${digest}\n")
endforeach()
string(SHA256 id "${content}")
file(WRITE "${OUTPUT}" "#include \"bench/sources/source_ids.hpp\"

namespace gnbv {

std::string ${FUNCTION}() { return \"${id}\"; }

}  // namespace gnbv
")
