# Reads cmake/rooms.txt: `courant_rooms` are the rooms with a folder of their own at the top, from left to right, and
# `courant_known_<room>` those that a room names. A part of a room ("integrators/maps") counts as the room.

set(rooms_file ${CMAKE_CURRENT_LIST_DIR}/rooms.txt)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${rooms_file})
file(STRINGS ${rooms_file} lines REGEX "^[a-z]")
set(courant_rooms "")
foreach(line IN LISTS lines)
  string(REGEX MATCH "^([a-z]+)(/[a-z_]+)?:(.*)$" matched "${line}")
  set(room ${CMAKE_MATCH_1})
  string(REGEX MATCHALL "[a-z/_]+" known "${CMAKE_MATCH_3}")
  list(TRANSFORM known REPLACE "/.*" "")
  list(REMOVE_ITEM known ${room})
  list(APPEND courant_rooms ${room})
  list(APPEND courant_known_${room} ${known})
endforeach()
list(REMOVE_DUPLICATES courant_rooms)
