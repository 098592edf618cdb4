#pragma once

#include <optional>
#include <span>

namespace fracbench {

/// Mott's law of fragment volumes: the share of fragments that are larger than V is
///
///   S(V) = exp(-cbrt(6 V / Vbar)),                                                    V >= 0,
///
/// so that cbrt(V) is exponentially distributed. Its mean is exactly Vbar, since the integral of S
/// is (Vbar / 2) * Gamma(3) = Vbar. With a cut c > 0 everything is conditional on V > c (left
/// truncation): S_c(V) = S(V) / S(c). (Equation (20) of Elek and Jaramaz, "Fragment size
/// distribution in dynamic fragmentation", 2008, which the DeepFracture paper refers to.)
struct Mott {
  double mean_volume = 1;  ///< Vbar > 0, of the law without a cut
  double cut = 0;          ///< c >= 0; same unit as the volumes

  double survival(double volume) const;  ///< share above `volume`; 1 at and below the cut
  double distribution(double volume) const { return 1 - survival(volume); }
  double quantile(double p) const;              ///< volume with distribution(volume) = p, p < 1
  double survival_integral(double from) const;  ///< of the survival over [from, infinity)
  double mean() const { return cut + survival_integral(cut); }  ///< of the fragments above the cut

  /// The law whose mean above `cut` is `mean_above` (method of moments; at cut 0 that is the law
  /// with Vbar = mean_above, as in the paper). None where mean_above is not above the cut.
  static std::optional<Mott> with_mean(double mean_above, double cut);
  /// The same from volumes, of which those at or below the cut are left out.
  static std::optional<Mott> fit(std::span<const double> volumes, double cut);
};

/// The formula as the DeepFracture paper prints it (section 6.3),
///
///   P(V) = exp(-zeta / cbrt(V)),  zeta = 6 / Vbar,
///
/// read as a distribution function, which is what the paper's text says. It is a Frechet
/// distribution of shape 1/3: its mean is infinite, for whichever Vbar. Kept to show the
/// difference; with a cut it is conditional on V > c: (P(V) - P(c)) / (1 - P(c)).
struct MottAsPrinted {
  double mean_volume = 1;  ///< Vbar > 0: enters zeta, and is not the mean
  double cut = 0;

  double distribution(double volume) const;
  double quantile(double p) const;  ///< p < 1
};

}  // namespace fracbench
