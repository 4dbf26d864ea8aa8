/// Lines for a human on stderr: "plumb-vo: ...". A repeating line is held back to one per second
/// and counted.
#pragma once

namespace plumb {

/// Name that begins every line; kept by pointer.
void set_log_name(const char* name);

/// One line, at once.
void log_line(const char* format, ...) __attribute__((format(printf, 1, 2)));

/// One line, at most once a second per `format` (told apart by its address, so pass a literal); the
/// next line says how many were held back.
void log_limited(const char* format, ...) __attribute__((format(printf, 1, 2)));

}  // namespace plumb
