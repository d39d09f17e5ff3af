// SPDX-License-Identifier: Apache-2.0
#include "core/interrupt.h"

#include <csignal>

#include <fmt/format.h>

#include "core/error.h"

namespace bounce {
namespace {

volatile std::sig_atomic_t g_signal = 0;

void remember(int signal) {
    g_signal = signal;
}

void handle(int signal, void (*handler)(int), int flags) {
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = flags;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard() {
    g_signal = 0;
    for (const int signal : {SIGINT, SIGTERM}) {
        // Back to the default after the first one; system calls go on as if nothing had happened.
        handle(signal, remember, static_cast<int>(static_cast<unsigned>(SA_RESETHAND) | SA_RESTART));
    }
}

InterruptGuard::~InterruptGuard() {
    for (const int signal : {SIGINT, SIGTERM}) {
        handle(signal, SIG_DFL, 0);
    }
}

bool InterruptGuard::interrupted() {
    return g_signal != 0;
}

void InterruptGuard::throw_if_interrupted(std::string_view state) const {
    if (g_signal != 0) {
        throw Error(g_signal == SIGTERM ? ExitCode::terminated : ExitCode::interrupted,
                    fmt::format("interrupted; {}", state));
    }
}

}  // namespace bounce
