include("${CMAKE_CURRENT_LIST_DIR}/yamaro.cmake")
