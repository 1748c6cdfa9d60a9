#include "cli/console.h"

#include <signal.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <new>
#include <system_error>
#include <utility>

#include "bakers/io/files/atomic_file.h"
#include "cli/events.h"
#include "config/diagnostics/diagnostic_codes.h"
#include "config/text/key_path.h"

namespace skybake::cli {
namespace {

bool is_machine_format(DiagnosticFormat format) {
    return format == DiagnosticFormat::json || format == DiagnosticFormat::sarif;
}

bool is_set(const char* variable) { return variable != nullptr && *variable != '\0'; }

bool forces(const char* variable) { return is_set(variable) && std::string_view(variable) != "0"; }

int columns_of_terminal(int descriptor) {
    winsize size{};
    return ::ioctl(descriptor, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

std::atomic<bool> signal_arrived{false};
static_assert(std::atomic<bool>::is_always_lock_free);

// A process that has not ended by itself so long after the first signal is ended.
constexpr long patience_ns = 800'000'000;
constexpr long pause_ns = 5'000'000;  // while files get their names
timer_t patience;
bool has_patience = false;

// The handlers only do what is allowed in one: they use atomics and timers, unlink, rmdir and
// _exit.
void end_at_once() {
    remove_unfinished_files();
    ::_exit(static_cast<int>(ExitCode::interrupted));
}

void end_after(long nanoseconds) {
    itimerspec once{};
    once.it_value.tv_nsec = nanoseconds;
    if (!has_patience || ::timer_settime(patience, 0, &once, nullptr) != 0) ::alarm(1);
}

void on_signal(int) {
    if (signal_arrived.exchange(true)) end_at_once();
    const int error = errno;
    end_after(patience_ns);
    errno = error;
}

void on_end_of_patience(int) {
    if (!is_renaming_files()) end_at_once();
    const int error = errno;
    end_after(pause_ns);
    errno = error;
}

// Makes a text of many lines, which may have tabs, safe for a terminal.
std::string printable_lines(std::string_view text) {
    std::string result;
    while (true) {
        const std::size_t end = std::min(text.find_first_of("\n\t"), text.size());
        result += config::printable(text.substr(0, end));
        if (end == text.size()) return result;
        result += text[end];
        text.remove_prefix(end + 1);
    }
}

// Returns diagnostics in which nothing controls a terminal. Their lines of text are left to the
// printer, which marks columns in them.
std::vector<Diagnostic> printable(std::vector<Diagnostic> diagnostics) {
    for (Diagnostic& diagnostic : diagnostics) {
        for (std::string* text :
             {&diagnostic.message, &diagnostic.label, &diagnostic.where.source}) {
            *text = config::printable(*text);
        }
    }
    return diagnostics;
}

// It was tried before whether the threads can begin, but other processes may have taken them since.
[[noreturn]] void end_of_process() {
    remove_unfinished_files();
    const char* reason = nullptr;  // without an exception, a thread that began has lost its owner
    try {
        if (const std::exception_ptr thrown = std::current_exception()) {
            reason = "of an unknown kind";
            std::rethrow_exception(thrown);
        }
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "error[E0307]: %s\n", kWantOfMemory);
        ::_exit(static_cast<int>(ExitCode::io));
    } catch (const std::exception& exception) {
        reason = is_want_of_threads(exception) ? nullptr : exception.what();
    } catch (...) {
    }
    if (reason == nullptr) {
        std::fprintf(stderr, "error[E0306]: %.*s\n", static_cast<int>(want_of_threads.size()),
                     want_of_threads.data());
        ::_exit(static_cast<int>(ExitCode::io));
    }
    std::fprintf(stderr, "error[E0500]: internal error: %s\n", reason);
    ::_exit(static_cast<int>(ExitCode::internal));
}

}  // namespace

Sink descriptor_sink(int descriptor) {
    Sink sink;
    sink.terminal = ::isatty(descriptor) == 1;
    if (sink.terminal) sink.columns = columns_of_terminal(descriptor);
    sink.write = [descriptor](std::string_view text) {
        while (!text.empty()) {
            const ssize_t count = ::write(descriptor, text.data(), text.size());
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) return false;
            text.remove_prefix(static_cast<std::size_t>(count));
        }
        return true;
    };
    return sink;
}

bool wants_color(WhenColor choice, bool terminal, const ColorEnvironment& environment) {
    if (choice == WhenColor::always) return true;
    if (choice == WhenColor::never || is_set(environment.no_color)) return false;
    return terminal || forces(environment.clicolor_force) || forces(environment.force_color);
}

Console::Console(Sink out, Sink error, Display display)
    : out_(std::move(out)), error_(std::move(error)), display_(display) {}

void Console::result(std::string_view text) {
    if (result_lost_ || out_.write(printable_lines(text))) return;
    result_lost_ = true;
    if (errno == EPIPE) return;  // whoever reads has seen enough
    write_error(fmt::format("error[E0301]: cannot write the result: {}\n",
                            std::generic_category().message(errno)));
}

bool Console::shows_notes() const {
    return !display_.quiet && !is_machine_format(display_.diagnostics);
}

void Console::write(bool results, std::string_view text) {
    results ? result(text) : write_error(text);
}

void Console::write_error(std::string_view text) {
    const std::lock_guard lock(error_mutex_);
    error_.write(text);
}

void Console::note(std::string_view text) {
    if (shows_notes()) write_error(printable_lines(text));
}

void Console::rewrite_line(std::string_view text) {
    if (shows_notes()) write_error("\r\033[K" + config::printable(text));
}

void Console::detail(std::string_view text) {
    if (display_.verbose) note(text);
}

ExitCode Console::report(std::span<const Diagnostic> diagnostics) {
    return report_to(false, diagnostics);
}

ExitCode Console::report_results(std::span<const Diagnostic> diagnostics) {
    return report_to(is_machine_format(display_.diagnostics), diagnostics);
}

ExitCode Console::report_to(bool results, std::span<const Diagnostic> diagnostics) {
    const std::vector<Diagnostic> all(diagnostics.begin(), diagnostics.end());
    if (display_.json) {
        reported_.insert(reported_.end(), diagnostics.begin(), diagnostics.end());
    }
    if (display_.diagnostics == DiagnosticFormat::sarif) {
        sarif_.insert(sarif_.end(), diagnostics.begin(), diagnostics.end());
        sarif_is_result_ = sarif_is_result_ || results;
    } else {
        const std::string text =
            print_diagnostics(is_machine_format(display_.diagnostics) ? all : printable(all),
                              display_.diagnostics, display_.color);
        write(results, text);
    }
    return static_cast<ExitCode>(config::exit_code(diagnostics));
}

ExitCode Console::finish(ExitCode code) {
    if (display_.diagnostics == DiagnosticFormat::sarif) {
        write(sarif_is_result_, print_diagnostics(sarif_, DiagnosticFormat::sarif));
        sarif_.clear();
    }
    const ExitCode last = exit_code(code);
    if (display_.json && last > ExitCode::differs) {
        result(failed_event(display_.command, last, reported_));
    }
    return exit_code(last);
}

ExitCode Console::exit_code(ExitCode code) const {
    if (interrupted()) return ExitCode::interrupted;
    return result_lost_ ? std::max(code, ExitCode::io) : code;
}

void install_signal_handlers() {
    struct sigaction action {};
    sigemptyset(&action.sa_mask);
    action.sa_handler = on_end_of_patience;
    ::sigaction(SIGALRM, &action, nullptr);
    has_patience = ::timer_create(CLOCK_MONOTONIC, nullptr, &patience) == 0;  // it sends SIGALRM
    action.sa_handler = on_signal;
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        // Under nohup the loss of the terminal (SIGHUP) stays ignored. Ctrl-C (SIGINT) is handled
        // even where it was ignored. Shells ignore it for commands that a script starts in the
        // background, but whoever sends it wants the program to stop.
        struct sigaction old {};
        const bool ignored = ::sigaction(number, nullptr, &old) == 0 && old.sa_handler == SIG_IGN;
        if (number == SIGHUP && ignored) continue;
        ::sigaction(number, &action, nullptr);
    }
    action.sa_handler = SIG_IGN;
    for (const int number : {SIGPIPE, SIGXFSZ}) ::sigaction(number, &action, nullptr);
}

bool interrupted() { return signal_arrived; }

bool is_want_of_threads(const std::exception& exception) {
    const auto* error = dynamic_cast<const std::system_error*>(&exception);
    return (error != nullptr && error->code() == std::errc::resource_unavailable_try_again) ||
           std::string_view(exception.what()).starts_with("pthread_create");  // of TBB
}

void install_end_of_process() { std::set_terminate(end_of_process); }

}  // namespace skybake::cli
