#pragma once

#include <cstddef>

#include "training/representation_study.h"
#include "training/training.h"

namespace fracbench::training {

/// Seconds of the processor's (or device's) wall clock for one step, the loss of a pattern and what
/// follows from it, measured on made-up patterns in some seconds. Of a network with outputs finer
/// than 64 the coarser ones are measured, and their time is scaled by the work (training_work): the
/// network of the paper at 256 would take a minute and ten gigabytes to be asked. Throws what
/// `train` throws.
double seconds_per_step(const TrainingOptions& options, const TrainingRun& run);

/// Seconds that a study takes for what its check points do not hold yet, measured on some diagrams
/// of its size for each representation, in some seconds. Throws what `study_representations`
/// throws.
double study_seconds(const neural::StudySettings& settings, const StudyRun& run);

}  // namespace fracbench::training
