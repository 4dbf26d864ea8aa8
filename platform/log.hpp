/// Log lines on stderr for people to read: "plumb-vo: ...".
///
/// Journal:
///   When stderr goes to systemd's journal, each line begins with its priority, "<4>" for a
///   warning, which the journal takes off.
/// Waiting:
///   Nothing here waits. A line that stderr does not take at once, because nobody reads the pipe,
///   is dropped; the next line that is taken says how many were.
/// Threads:
///   One thread logs; the functions share a table without locks.
/// Memory:
///   Nothing is allocated; a line is cut at 511 characters.
#pragma once

namespace plumb {

/// Sets the name that begins every line. Only the pointer is kept.
void set_log_name(const char* name);

/// Writes one line: information, something that is not as it should be, the reason of an end.
void log_line(const char* format, ...) __attribute__((format(printf, 1, 2)));
void log_warning(const char* format, ...) __attribute__((format(printf, 1, 2)));
void log_error(const char* format, ...) __attribute__((format(printf, 1, 2)));

/// Writes at most one warning a second per `format`; the next line states how many were suppressed.
/// Formats are told apart by their addresses, so `format` must be a string literal.
void log_limited(const char* format, ...) __attribute__((format(printf, 1, 2)));

}  // namespace plumb
