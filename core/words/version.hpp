// The version of the library that a program is compiled with.
#pragma once

#define COURANT_VERSION_MAJOR 0
#define COURANT_VERSION_MINOR 1
#define COURANT_VERSION_PATCH 0
#define COURANT_VERSION_STRING "0.1.0"

// For comparisons: COURANT_VERSION >= 10200 is version 1.2.0 or later.
#define COURANT_VERSION \
  (COURANT_VERSION_MAJOR * 10000 + COURANT_VERSION_MINOR * 100 + COURANT_VERSION_PATCH)
