#include "cli/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>

#include "bakers/io/files/atomic_file.h"
#include "cli/exit_code.h"

namespace skybake::cli {
namespace {

std::atomic<bool> signal_arrived{false};
static_assert(std::atomic<bool>::is_always_lock_free);

// Does only what is allowed in a handler: an atomic, unlink, _exit.
void on_signal(int) {
    if (!signal_arrived.exchange(true)) return;
    unlink_current_temporaries();
    ::_exit(static_cast<int>(ExitCode::interrupted));
}

}  // namespace

void install_signal_handlers() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        // Under nohup a lost terminal stays ignored. Ctrl-C does not, though shells ignore it for
        // what scripts start in the background: whoever sends it means it.
        struct sigaction old {};
        const bool ignored = ::sigaction(number, nullptr, &old) == 0 && old.sa_handler == SIG_IGN;
        if (number == SIGHUP && ignored) continue;
        ::sigaction(number, &action, nullptr);
    }
    action.sa_handler = SIG_IGN;
    for (const int number : {SIGPIPE, SIGXFSZ}) ::sigaction(number, &action, nullptr);
}

bool interrupted() { return signal_arrived; }

}  // namespace skybake::cli
