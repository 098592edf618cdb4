#pragma once

namespace fracbench::training {

/// Whether libtorch's convolutions of single precision, and their derivatives by the input, are
/// right on the processor: a few of them, with numbers of channels that fill no vector, against
/// double precision, which libtorch computes without oneDNN.
bool convolutions_are_right();

/// Where they are not, libtorch computes without oneDNN from here on, which is slower.
/// oneDNN 3.7.2, with which Debian 13 builds libtorch 2.6, gets some with kernel 4 wrong by
/// AVX-512.
void use_right_convolutions();

}  // namespace fracbench::training
