// This header handles what the process tells the world and what signals tell the process: results
// on stdout, words for people and diagnostics on stderr, the exit code, and interruptions.
#pragma once

#include <exception>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/diagnostic_printer.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

// These are the exit codes of the process. main.cpp is the only place that exits.
enum class ExitCode : int {
    done = 0,
    differs = 1,   // a comparison or verification differs
    usage = 2,     // usage or parameter error
    io = 3,        // cannot open, read or write
    checks = 4,    // the result failed its physical or error checks
    internal = 5,  // a mistake in the program
    interrupted = 130,
};

// Says that the system gave no memory (E0307).
inline constexpr const char* kWantOfMemory =
    "there is not enough memory; bake less at once, or with fewer threads";

// This is where text goes. `write` returns false once the other end is gone or the disk is full.
struct Sink {
    std::function<bool(std::string_view)> write;
    bool terminal = false;
    int columns = 0;  // of the terminal; 0 if not known
};

// Returns a sink that writes to a file descriptor (1 or 2). It writes whole texts, whatever signals
// arrive.
Sink descriptor_sink(int descriptor);

struct Display {
    DiagnosticFormat diagnostics = DiagnosticFormat::human;
    bool color = false;        // on stderr
    bool quiet = false;        // -q: no notes
    bool verbose = false;      // -v: details too
    bool json = false;         // --json: results and failures are events on stdout
    std::string command = {};  // for the event of a failure; empty if no command was understood
};

// This is what the environment says about colours. A pointer is null if the variable is not set.
struct ColorEnvironment {
    const char* no_color = nullptr;        // https://no-color.org
    const char* clicolor_force = nullptr;  // https://bixense.com/clicolors
    const char* force_color = nullptr;     // https://force-color.org
};

enum class WhenColor { automatic, always, never };

// Whether to colour a stream. --color=always and --color=never decide. With auto, NO_COLOR turns
// colours off, else CLICOLOR_FORCE or FORCE_COLOR turns them on, else a terminal gets them. An
// empty variable counts as not set, and `0` forces nothing.
bool wants_color(WhenColor choice, bool terminal, const ColorEnvironment& environment);

// Writes to stdout and stderr. It never throws if a stream is gone. Once a result could not be
// written, the exit code of the process becomes `io` (see finish). Notes may come from any thread.
class Console {
  public:
    Console(Sink out, Sink error, Display display);

    // Writes a text to stdout. The text brings its own newlines. Whatever files and folders are called,
    // nothing that would control a terminal reaches it; this holds for notes, too.
    void result(std::string_view text);
    // Writes to stderr. It writes nothing if -q was given or if diagnostics are for a machine
    // (json, sarif), which then has stderr to itself.
    void note(std::string_view text);
    // Writes a note over the last line of a terminal.
    void rewrite_line(std::string_view text);
    // Writes to stderr, only with -v.
    void detail(std::string_view text);

    // Prints diagnostics to stderr as --diagnostics wants them, and returns the exit code of the
    // gravest (done if there are none or only warnings).
    ExitCode report(std::span<const Diagnostic> diagnostics);
    // Does the same for a command whose results are diagnostics (check): json and sarif go to
    // stdout.
    ExitCode report_results(std::span<const Diagnostic> diagnostics);

    // Writes what waits for the end of the run, which is a SARIF document and the event of a
    // failure, and returns the exit code for the process.
    ExitCode finish(ExitCode code);

    const Display& display() const { return display_; }
    bool json() const { return display_.json; }
    bool error_is_terminal() const { return error_.terminal; }
    bool shows_notes() const;
    // Returns the columns of the terminal that notes go to, or 0 if there is no terminal or it does
    // not say.
    int error_columns() const { return error_.columns; }

  private:
    ExitCode report_to(bool results, std::span<const Diagnostic> diagnostics);
    void write(bool results, std::string_view text);
    void write_error(std::string_view text);
    ExitCode exit_code(ExitCode code) const;

    std::mutex error_mutex_;
    Sink out_;
    Sink error_;
    Display display_;
    bool result_lost_ = false;
    bool sarif_is_result_ = false;
    std::vector<Diagnostic> sarif_;
    std::vector<Diagnostic> reported_;  // kept with --json
};

// --- Signals such as Ctrl-C ----------------------------------------------------------------------

// Takes over SIGINT, SIGTERM, SIGHUP and SIGALRM, and ignores SIGPIPE and SIGXFSZ, whose errors the
// writes report. The first signal asks the bake to stop and leave no partial file. If the process
// has not ended 0.8 s later, or when a second signal arrives, it is ended at once, and leaves no
// partial file either: whatever is being computed or read, a signal is obeyed within a second.
void install_signal_handlers();

// True once a signal has arrived.
bool interrupted();

// Ends the process without a partial file when a library gives up. Libraries do so where a thread of
// theirs cannot begin, which E0306 says; everything else is a mistake in the program.
void install_end_of_process();

inline constexpr std::string_view want_of_threads =
    "the system lets this process begin no more threads (ulimit -u, or pids.max of a container)";

// Whether an exception says that a thread could not begin.
bool is_want_of_threads(const std::exception& exception);

}  // namespace skybake::cli
