#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>

#include <SQLiteCpp/Database.h>

namespace plumbline::reports::detail {

/// Marks a SQLite file as one of ours: "PLmb", in its header (PRAGMA application_id).
inline constexpr int kApplicationId = 0x504c6d62;

/// How long a process waits for others that write [ms]. A run is written in well under a second.
inline constexpr int kBusyTimeout = 120'000;

/// What brings a file from version i to version i + 1, i the place in the list.
std::span<const char* const> migrations();

/// Opens the file, with write-ahead log, and brings it up to the version that the steps lead to.
///
/// @param make  whether the file may be missing
/// @throws HistoryError, std::system_error
std::unique_ptr<SQLite::Database> open_database(const std::filesystem::path& file, bool make,
                                                std::span<const char* const> steps);

/// Calls what asks the database, and says in our words what SQLite says.
///
/// @throws HistoryError, std::system_error for a disk that is full or fails
void ask(const std::filesystem::path& file, const std::function<void()>& question);

}  // namespace plumbline::reports::detail
