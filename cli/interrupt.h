// Ctrl-C and its kin. The first signal asks the bake to stop and leave no partial file, a second
// one ends the process at once (and leaves none either).
#pragma once

namespace skybake::cli {

// Takes over SIGINT, SIGTERM and SIGHUP; ignores SIGPIPE and SIGXFSZ, whose errors the writes
// report.
void install_signal_handlers();

// True once a signal has arrived.
bool interrupted();

}  // namespace skybake::cli
