#include "history_schema.h"

#include <sqlite3.h>

#include <cerrno>
#include <chrono>
#include <string>
#include <system_error>
#include <thread>

#include <SQLiteCpp/Exception.h>
#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/Transaction.h>

#include <plumbline/reports/errors.h>

namespace plumbline::reports::detail {
namespace {

// Seeds have 64 bits without a sign, which SQLite has not: they are text, as are lists and records,
// in JSON. What is not a number is NULL.
constexpr const char* kFirst = R"sql(
CREATE TABLE run (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  kind TEXT NOT NULL,
  time TEXT NOT NULL,
  commit_hash TEXT NOT NULL,
  sources TEXT NOT NULL,
  seed TEXT NOT NULL,
  comparable TEXT NOT NULL,
  environment TEXT NOT NULL
);
CREATE INDEX run_comparable ON run (comparable, id);
CREATE TABLE part (
  run INTEGER NOT NULL REFERENCES run,
  name TEXT NOT NULL,
  status TEXT NOT NULL,
  seconds REAL,
  note TEXT NOT NULL
);
CREATE INDEX part_run ON part (run);
CREATE TABLE seed_run (run INTEGER NOT NULL REFERENCES run, record TEXT NOT NULL);
CREATE INDEX seed_run_run ON seed_run (run);
CREATE TABLE subject (
  id INTEGER PRIMARY KEY,
  kind TEXT NOT NULL,
  name TEXT NOT NULL,
  UNIQUE (kind, name)
);
CREATE TABLE check_result (
  run INTEGER NOT NULL REFERENCES run,
  subject INTEGER NOT NULL REFERENCES subject,
  verdict TEXT NOT NULL,
  expected TEXT NOT NULL,
  waived INTEGER NOT NULL,
  estimate REAL, reference REAL, tolerance REAL, bound REAL, p_value REAL,
  samples INTEGER NOT NULL,
  seconds REAL,
  figures TEXT,
  record TEXT
);
CREATE INDEX check_run ON check_result (run);
CREATE INDEX check_subject ON check_result (subject, run);
CREATE TABLE quantity (
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL,
  unit TEXT NOT NULL,
  better TEXT NOT NULL,
  UNIQUE (name, unit, better)
);
CREATE TABLE distribution (
  run INTEGER NOT NULL REFERENCES run,
  quantity INTEGER NOT NULL REFERENCES quantity,
  measured TEXT NOT NULL
);
CREATE INDEX distribution_run ON distribution (run);
CREATE INDEX distribution_quantity ON distribution (quantity, run);
CREATE TABLE counter (
  run INTEGER NOT NULL REFERENCES run,
  quantity INTEGER NOT NULL REFERENCES quantity,
  value INTEGER NOT NULL
);
CREATE INDEX counter_run ON counter (run);
CREATE INDEX counter_quantity ON counter (quantity, run);
)sql";

constexpr const char* kMoveAway = "; move it away, and the next night begins a new history";

constexpr const char* kMigrations[] = {kFirst};

int number(const SQLite::Database& database, const char* query) {
  SQLite::Statement statement(database, query);
  return statement.executeStep() ? statement.getColumn(0).getInt() : 0;
}

/// The mode stays in the file. Two processes that make it at once are in each other's way for the
/// moment of the change, for which SQLite does not wait by itself.
void use_write_ahead_log(SQLite::Database& database) {
  for (int attempt = 0;; ++attempt) {
    SQLite::Statement mode(database, "PRAGMA journal_mode = WAL");
    const int code = mode.tryExecuteStep();
    if (code == SQLITE_ROW && mode.getColumn(0).getString() == "wal") return;
    if (code != SQLITE_BUSY || attempt == kBusyTimeout / 10) {
      throw SQLite::Exception("cannot keep a write-ahead log there", code);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

void require_ours(const SQLite::Database& database, const std::filesystem::path& file, int newest) {
  // In this order: another process may be making the tables, with id and version, at this moment.
  const bool used = number(database, "SELECT count(*) FROM sqlite_schema") > 0;
  const int id = number(database, "PRAGMA application_id");
  const int version = number(database, "PRAGMA user_version");
  if (id != kApplicationId && (id != 0 || version != 0 || used)) {
    throw HistoryError(file.string() + ": a database of another program, no history of ours");
  }
  if (version < 0) {
    throw HistoryError(file.string() + ": states version " + std::to_string(version) + kMoveAway);
  }
  if (version > newest) {
    throw HistoryError(file.string() + ": a history of version " + std::to_string(version) +
                       ", and this Plumbline knows those up to " + std::to_string(newest) +
                       "; use a later Plumbline");
  }
}

/// All steps that are missing, in one transaction; another process may have taken them meanwhile.
void migrate(SQLite::Database& database, const std::filesystem::path& file,
             std::span<const char* const> steps) {
  const int newest = static_cast<int>(steps.size());
  require_ours(database, file, newest);
  if (number(database, "PRAGMA user_version") == newest) return;
  SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
  require_ours(database, file, newest);
  for (int v = number(database, "PRAGMA user_version"); v < newest; ++v) {
    database.exec(steps[static_cast<std::size_t>(v)]);
    database.exec("PRAGMA user_version = " + std::to_string(v + 1));
  }
  database.exec("PRAGMA application_id = " + std::to_string(kApplicationId));
  transaction.commit();
}

}  // namespace

std::span<const char* const> migrations() { return kMigrations; }

std::unique_ptr<SQLite::Database> open_database(const std::filesystem::path& file, bool make,
                                                std::span<const char* const> steps) {
  if (!make && !std::filesystem::exists(file)) {
    throw HistoryError(file.string() + ": there is no such history; ./run nightly makes one");
  }
  if (make && file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  std::unique_ptr<SQLite::Database> database;
  ask(file, [&] {
    const int flags = SQLite::OPEN_READWRITE | (make ? SQLite::OPEN_CREATE : 0);
    database = std::make_unique<SQLite::Database>(file.string(), flags, kBusyTimeout);
    require_ours(*database, file, static_cast<int>(steps.size()));  // before anything is written
    use_write_ahead_log(*database);
    migrate(*database, file, steps);
  });
  return database;
}

void ask(const std::filesystem::path& file, const std::function<void()>& question) {
  try {
    question();
  } catch (const SQLite::Exception& error) {
    const int code = error.getErrorCode();
    if (code == SQLITE_FULL)
      throw std::system_error(ENOSPC, std::generic_category(), file.string());
    if (code == SQLITE_IOERR) throw std::system_error(EIO, std::generic_category(), file.string());
    std::string what = file.string() + ": " + error.what();
    if (code == SQLITE_NOTADB || code == SQLITE_CORRUPT) {
      what += kMoveAway;
    } else if (code == SQLITE_BUSY) {
      what += "; another program has been writing to it for two minutes";
    }
    throw HistoryError(what);
  } catch (const FormatError& error) {
    throw HistoryError(file.string() + ": holds what no history does: " + error.what() + kMoveAway);
  }
}

}  // namespace plumbline::reports::detail
