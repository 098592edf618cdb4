#pragma once

#include <cstddef>

#include "training/training.h"

namespace fracbench::training {

/// Seconds of the processor's (or device's) wall clock for one step, the loss of a pattern and what
/// follows from it, measured on made-up patterns in some seconds. Of a network with outputs finer
/// than 64 the coarser ones are measured, and their time is scaled by the work (training_work): the
/// network of the paper at 256 would take a minute and ten gigabytes to be asked. Throws what
/// `train` throws.
double seconds_per_step(const TrainingOptions& options, const TrainingRun& run);

}  // namespace fracbench::training
