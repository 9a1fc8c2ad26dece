/// @file
/// How fast this machine is, beside the one on which the constants of forecasts were fitted.
#pragma once

namespace microslip::pipelines {

/// Processor seconds that a fixed piece of work takes here, over those it took there: above 1
/// where the machine, or the share of it that other programs leave, is slower. The work is of the
/// kind that curves are made of: products of dense matrices, sines and branches that hang on them.
/// Measured once per process, in some 15 ms; equal for the rest of it. Seconds are multiplied by it
/// that are told, compared with a budget of time, or, of modes from an earlier run, with measured
/// ones; nothing else hangs on it.
[[nodiscard]] double machine_slowness();

}  // namespace microslip::pipelines
