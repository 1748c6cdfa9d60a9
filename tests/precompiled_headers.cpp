// Nothing but what tests/precompiled_headers.cmake puts before it.
