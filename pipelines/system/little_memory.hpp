/// @file
/// The end of a program that has no memory left: exit code 4 in words,
/// wherever an allocation fails.
#pragma once

namespace microslip::pipelines {

/// Keeps a megabyte back that is given free when an allocation fails for the first time: what goes
/// on, or unwinds and says why, has that much. Destructors of libraries that allocate have no way
/// to fail: where an exception ends in one of them, and memory had run out, the program ends at
/// once with the exit code of that, else with the one of an internal error; never by a signal. To
/// be called once, by main().
void prepare_for_little_memory();

}  // namespace microslip::pipelines
