# find_package(gnbv): gnbv::planner, and gnbv::planner_map and so on, of which it consists.
include(CMakeFindDependencyMacro)
find_dependency(Threads)
find_dependency(Eigen3 3.4)
find_dependency(fmt)
find_dependency(OpenSSL COMPONENTS Crypto)
find_dependency(PNG)
include(${CMAKE_CURRENT_LIST_DIR}/gnbv-targets.cmake)
