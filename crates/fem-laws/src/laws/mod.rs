//! Contact laws F(ξ, ξ̇), and laws of contacts that dent: each a function that returns its [`ContactLaw`], and the table of all of them.

mod elastic_plastic;
mod hunt_crossley;
mod kuwabara_kono;
mod linear;
mod mdr;
mod mean_pressure;
mod power;
mod published;
mod schwager_poeschel;
mod tsuji;

pub(crate) use elastic_plastic::Rebound;
pub use elastic_plastic::{
    ElasticPlastic, brake, flow_of, jackson_green, jackson_green_values, johnson, johnson_values,
    luding, mdr, mdr_values, mean_pressure, mean_pressure_values, thornton, thornton_values,
    walton_braun,
};
pub use hunt_crossley::{hunt_crossley, hunt_crossley_values};
pub use kuwabara_kono::{corrected_dissipation_time, kuwabara_kono, kuwabara_kono_values};
pub use linear::{linear, linear_damping, linear_from_restitution, linear_values};
pub(crate) use mean_pressure::REPRESENTATIVE_STRAIN;
pub use power::{ContactLaw, EndRule, power};
pub use published::{
    bordbar_hyppanen, falcon, hertz, hertz_dashpot, mishra_murty, morgado_oppenheim,
};
pub use schwager_poeschel::{dissipation_time, schwager_poeschel, schwager_poeschel_values};
pub use tsuji::{tsuji, tsuji_coefficient, tsuji_values, zhang_whiten_coefficient};

/// The table of contact laws. It calls a macro with one row per law; [`crate::LawFamily`], the tables of
/// case files, their checks and their JSON schema are made from it.
///
/// A row holds, in this order:
///
/// - the law's variant, its name, the type of its table in a case file and what serde expects there;
/// - `formula`: the [`ContactLaw`] from the pair and the parameters, in the order of the keys, as a call of a
///   function of this module; two rows may call the same one;
/// - `given by`: alternative sets of keys, of which a case gives exactly one, each key with its
///   [`crate::KeyNeed`] unless it is required; `values` names the function that turns keys into
///   parameters where they are not the parameters themselves;
/// - `ends at`: the [`EndRule`], where it is part of the law;
/// - `keys`: each with its kind of quantity ([`crate::KeyKind`]), its [`crate::KeyRange`] and, if it is a
///   parameter that a fit may vary, how ([`crate::LawParameter`]).
#[macro_export]
macro_rules! contact_laws {
    ($rows:ident) => {
        $rows! {
            /// F = k ξ + c ξ̇.
            Linear, linear, LinearTable, "a table such as { k = \"1e7 N/m\", c = \"30 N s/m\" }";
            formula(_pair, [k, c]) = laws::linear(k, c);
            given by [k, c: KeyNeed::Default(0.0)] [e, contact_time] [k, e],
                values laws::linear_values;
            keys {
                /// Stiffness, > 0; with `c` or `e`.
                k: Stiffness, Positive, Role::STIFFNESS;
                /// Damping, ≥ 0; 0 if absent.
                c: Damping, NotNegative, Role::DAMPING;
                /// Restitution, > 0 and ≤ 1, under the law's `end`; with `k` or `contact_time`, in place of `c`.
                e: Number, Restitution;
                /// Contact time, > 0; with `e`.
                contact_time: Time, Positive;
            }

            /// F = k ξ^gamma + c ξ^n ξ̇.
            Power, power, PowerTable, "a table such as { k = 3e9, gamma = 1.5, c = 1e4, n = 0.5 }";
            formula(_pair, [k, gamma, c, n]) = laws::power(k, gamma, c, n);
            given by [k, gamma, c: KeyNeed::Default(0.0), n: KeyNeed::With("c")];
            keys {
                /// Stiffness, N/m^gamma, > 0.
                k: Number, Positive, Role::STIFFNESS.in_unit("N/m^gamma");
                /// Exponent of the spring, > 0.
                gamma: Number, Positive, Role::number(Some(1.5), (0.1, 5.0));
                /// Damping, N s/m^(n+1), ≥ 0; 0 if absent.
                c: Number, NotNegative, Role::DAMPING.in_unit("N s/m^(n+1)");
                /// Exponent of the dashpot, ≥ 0; wanted with `c`.
                n: Number, NotNegative, Role::DAMPING_EXPONENT;
            }

            /// Hertz' spring without a dashpot, integrated as a law.
            Hertz, hertz, HertzLawTable, "a table such as {}";
            formula(pair, []) = laws::hertz(pair);
            given by [];
            keys {}

            /// Hertz' spring with the damping of a Kelvin solid.
            KuwabaraKono, kuwabara_kono, KuwabaraKonoTable, "a table such as { a = \"1e-6 s\" }";
            formula(pair, [a]) = laws::kuwabara_kono(pair, a);
            given by [a] [eta_1, eta_2] [], values laws::kuwabara_kono_values;
            keys {
                /// Dissipation time A, ≥ 0; absent: from `eta_1` and `eta_2`, or else from the materials.
                a: Time, NotNegative, Role::DAMPING;
                /// Viscosity in shear, ≥ 0; with `eta_2`.
                eta_1: Viscosity, NotNegative;
                /// Viscosity in compression, ≥ 0.
                eta_2: Viscosity, NotNegative;
            }

            /// Hertz' spring with damping in proportion to its force.
            HuntCrossley, hunt_crossley, HuntCrossleyTable, "a table such as { e = 0.9 }";
            formula(pair, [e, v]) = laws::hunt_crossley(pair, e, v);
            given by [e, v: KeyNeed::Optional], values laws::hunt_crossley_values;
            keys {
                /// Restitution wanted, > 0 and ≤ 1.
                e: Number, Restitution, Role::number(None, (1e-6, 1.0)).starting_at(0.8);
                /// Approach speed at which it is wanted, > 0; the case's if absent.
                v: Speed, Positive, Role::SPEED;
            }

            /// Hertz' spring with a restitution independent of speed.
            Tsuji, tsuji, TsujiTable, "a table such as { e = 0.9 }";
            formula(pair, [alpha]) = laws::tsuji(pair, alpha);
            given by [e] [alpha], values laws::tsuji_values;
            keys {
                /// Restitution wanted, > 0 and ≤ 1, under the law's `end`.
                e: Number, Restitution;
                /// Damping coefficient α, ≥ 0, in place of `e`.
                alpha: Number, NotNegative, Role::DAMPING;
            }

            /// The law of `tsuji` for a contact that ends at zero force.
            ZhangWhiten, zhang_whiten, ZhangWhitenTable, "a table such as { e = 0.9 }";
            formula(pair, [alpha]) = laws::tsuji(pair, alpha);
            given by [e] [alpha], values laws::tsuji_values;
            ends at ZeroForce;
            keys {
                /// Restitution wanted, > 0 and ≤ 1.
                e: Number, Restitution;
                /// Damping coefficient α, ≥ 0, in place of `e`.
                alpha: Number, NotNegative, Role::DAMPING;
            }

            /// Hertz' spring with the damping c ξ^(1/4) ξ̇.
            Falcon, falcon, FalconTable, "a table such as { c = 500 }";
            formula(pair, [c]) = laws::falcon(pair, c);
            given by [c];
            keys {
                /// Damping, N s/m^(5/4), ≥ 0.
                c: Number, NotNegative, Role::DAMPING.in_unit("N s/m^(5/4)");
            }

            /// Hertz' spring with a constant dashpot, c ξ̇.
            HertzDashpot, hertz_dashpot, HertzDashpotTable, "a table such as { c = \"10 N s/m\" }";
            formula(pair, [c]) = laws::hertz_dashpot(pair, c);
            given by [c];
            keys {
                /// Damping, ≥ 0.
                c: Damping, NotNegative, Role::DAMPING;
            }

            /// F = k ξ^(8/5) + c ξ^(4/5) ξ̇.
            MishraMurty, mishra_murty, MishraMurtyTable, "a table such as { k = 1e10, c = 1e5 }";
            formula(_pair, [k, c]) = laws::mishra_murty(k, c);
            given by [k, c];
            keys {
                /// Stiffness, N/m^(8/5), > 0.
                k: Number, Positive, Role::STIFFNESS.in_unit("N/m^(8/5)");
                /// Damping, N s/m^(9/5), ≥ 0.
                c: Number, NotNegative, Role::DAMPING.in_unit("N s/m^(9/5)");
            }

            /// Kelvin's damping from the viscosities of the material.
            SchwagerPoeschel, schwager_poeschel, SchwagerPoeschelTable,
                "a table such as { a = \"1e-6 s\" }";
            formula(pair, [a]) = laws::schwager_poeschel(pair, a);
            given by [a] [eta_1, eta_2], values laws::schwager_poeschel_values;
            keys {
                /// Normal damping C_n, ≥ 0; or `eta_1` and `eta_2`.
                a: Time, NotNegative, Role::DAMPING;
                /// Viscosity in shear, > 0; with `eta_2`.
                eta_1: Viscosity, Positive;
                /// Viscosity in compression, > 0.
                eta_2: Viscosity, Positive;
            }

            /// Hertz' spring with a damping of the spring's own form.
            MorgadoOppenheim, morgado_oppenheim, MorgadoOppenheimTable,
                "a table such as { eta_1 = \"1e4 Pa s\", eta_2 = 0.2 }";
            formula(pair, [eta_1, eta_2]) = laws::morgado_oppenheim(pair, eta_1, eta_2);
            given by [eta_1, eta_2];
            keys {
                /// Viscoelastic coefficient in place of E, ≥ 0.
                eta_1: Viscosity, NotNegative, Role::DAMPING;
                /// Viscoelastic coefficient in place of ν, between −1 and 1.
                // At 0, the middle of the limits, nothing depends on it in first order.
                eta_2: Number, LikePoissonsRatio, Role::number(None, (-0.99, 0.99)).starting_at(0.25);
            }

            /// Hertz' spring with the damping 2 A E* R*^(1−n) ξ^n ξ̇.
            BordbarHyppanen, bordbar_hyppanen, BordbarHyppanenTable,
                "a table such as { a = \"1e-6 s\", n = 0.65 }";
            formula(pair, [a, n]) = laws::bordbar_hyppanen(pair, a, n);
            given by [a, n];
            keys {
                /// Dissipation time A, ≥ 0.
                a: Time, NotNegative, Role::DAMPING;
                /// Exponent of the dashpot, ≥ 0.
                n: Number, NotNegative, Role::DAMPING_EXPONENT;
            }

            /// Hertz' spring up to first yield, then a constant pressure; unloading of a flattened sphere.
            Thornton, thornton, ThorntonTable, "a table such as { yield_strength = \"1 GPa\" }";
            formula(pair, [yield_pressure]) = laws::thornton(pair, yield_pressure);
            given by [yield_strength: KeyNeed::Optional] [yield_pressure], values laws::thornton_values;
            ends at ZeroForce;
            keys {
                /// Yield strength, > 0; absent: that of the material that yields first.
                yield_strength: Stress, Positive;
                /// Contact pressure of first yield, > 0, in place of `yield_strength`.
                yield_pressure: Stress, Positive, Role::STRENGTH;
            }

            /// A constant pressure from the start; unloading of a flattened sphere.
            Johnson, johnson, JohnsonTable, "a table such as { hardness = \"3 GPa\" }";
            formula(pair, [hardness]) = laws::johnson(pair, hardness);
            given by [yield_strength: KeyNeed::Optional] [hardness], values laws::johnson_values;
            ends at ZeroForce;
            keys {
                /// Yield strength, > 0, a third of the hardness; absent: that of the material that yields first.
                yield_strength: Stress, Positive;
                /// Dynamic hardness, > 0, in place of `yield_strength`.
                hardness: Stress, Positive, Role::STRENGTH;
            }

            /// A fit to finite elements of an elastic–perfectly plastic sphere on a flat.
            JacksonGreen, jackson_green, JacksonGreenTable,
                "a table such as { yield_strength = \"1 GPa\" }";
            formula(pair, [yield_strength, nu]) = laws::jackson_green(pair, yield_strength, nu);
            given by [yield_strength: KeyNeed::Optional, nu: KeyNeed::Optional],
                values laws::jackson_green_values;
            ends at ZeroForce;
            keys {
                /// Yield strength, > 0; absent: that of the material that yields first.
                yield_strength: Stress, Positive, Role::STRENGTH;
                /// Poisson's ratio of the body that flows; absent: the material's.
                nu: Number, LikePoissonsRatio, Role::number(Some(0.3), (0.0, 0.5));
            }

            /// The loading of `jackson_green`; unloading of a sphere with Hertz' contact radius.
            Brake, brake, BrakeTable, "a table such as { yield_strength = \"1 GPa\" }";
            formula(pair, [yield_strength, nu]) = laws::brake(pair, yield_strength, nu);
            given by [yield_strength: KeyNeed::Optional, nu: KeyNeed::Optional],
                values laws::jackson_green_values;
            ends at ZeroForce;
            keys {
                /// Yield strength, > 0; absent: that of the material that yields first.
                yield_strength: Stress, Positive, Role::STRENGTH;
                /// Poisson's ratio of the body that flows; absent: the material's.
                nu: Number, LikePoissonsRatio, Role::number(Some(0.3), (0.0, 0.5));
            }

            /// A fit to finite elements of an elastic–plastic sphere: the best of the laws that dent.
            MeanPressure, mean_pressure, MeanPressureTable,
                "a table such as { yield_strength = \"1 GPa\" }";
            formula(
                pair,
                [
                    yield_strength,
                    nu,
                    modulus,
                    strain,
                    exponent,
                    flattening_share,
                    elastic_share
                ]
            ) = laws::mean_pressure(
                pair,
                FlowStress { yield_strength, modulus, strain, exponent },
                nu,
                [flattening_share, elastic_share]
            );
            given by [
                yield_strength: KeyNeed::Optional,
                nu: KeyNeed::Optional,
                hardening: KeyNeed::Optional,
                hardening_strain: KeyNeed::Optional,
                hardening_exponent: KeyNeed::Optional,
                flattening_share: KeyNeed::Optional,
                elastic_share: KeyNeed::Optional
            ], values laws::mean_pressure_values;
            ends at ZeroForce;
            keys {
                /// Yield strength, > 0; absent: that of the material that yields first.
                yield_strength: Stress, Positive, Role::STRENGTH;
                /// Poisson's ratio of the body that flows; absent: the material's.
                nu: Number, LikePoissonsRatio, Role::number(Some(0.3), (0.0, 0.5));
                /// Slope of the flow stress over the plastic strain, ≥ 0; absent: that of a linear flow rule of the material.
                hardening: Stress, NotNegative, Role::HARDENING;
                /// Reference strain of Swift's law, > 0; absent: that of the material's flow rule near the strain of the contact.
                hardening_strain: Number, Positive, Role::number(Some(1.0), (1e-12, 1e12));
                /// Exponent of Swift's law, ≥ 0; absent: that of the material's flow rule near the strain of the contact.
                hardening_exponent: Number, NotNegative, Role::number(Some(0.0), (0.0, 1.0));
                /// Share of the bodies that flow in the flattening of a wide contact: 1 for a ball on a flat, 1/2 for like balls that both flow,
                /// 3/4 if one of them does; absent: the case's.
                flattening_share: Number, NotNegative, Role::number(Some(1.0), (0.0, 1.0));
                /// Share of a partner that stays elastic in the compliance 1/E\\*: 0 for a rigid one or if both flow; absent: the
                /// case's.
                elastic_share: Number, NotNegative, Role::number(Some(0.0), (0.0, 1.0));
            }

            /// The law of LAMMPS' `mdr`: a mean pressure that falls with the depth; a flat that springs back.
            Mdr, mdr, MdrTable, "a table such as { yield_strength = \"1 GPa\" }";
            formula(pair, [yield_strength, nu, radius_ratio]) =
                laws::mdr(pair, yield_strength, nu, radius_ratio);
            given by [
                yield_strength: KeyNeed::Optional,
                nu: KeyNeed::Optional,
                radius_ratio: KeyNeed::Optional
            ], values laws::mdr_values;
            ends at ZeroForce;
            keys {
                /// Yield strength, > 0; absent: that of the material that yields first.
                yield_strength: Stress, Positive, Role::STRENGTH;
                /// Poisson's ratio of the body that flows; absent: the material's.
                nu: Number, LikePoissonsRatio, Role::number(Some(0.3), (0.0, 0.5));
                /// Radius of the smaller sphere over that of the larger one, 0 for a sphere on a flat; absent: the case's.
                radius_ratio: Number, NotNegative, Role::number(Some(0.0), (0.0, 1.0));
            }

            /// A spring that springs back stiffer, with a restitution independent of speed.
            WaltonBraun, walton_braun, WaltonBraunTable,
                "a table such as { e = 0.8, k1 = \"1e6 N/m\" }";
            formula(pair, [e, k1]) = laws::walton_braun(pair, e, k1);
            given by [e, k1];
            ends at ZeroForce;
            keys {
                /// Restitution, > 0 and ≤ 1.
                e: Number, Restitution, Role::number(None, (1e-6, 1.0)).starting_at(0.8);
                /// Stiffness of the loading, > 0.
                k1: Stiffness, Positive, Role::STIFFNESS;
            }

            /// A spring that springs back the stiffer the deeper it went; without adhesion.
            Luding, luding, LudingTable,
                "a table such as { kp_over_k1 = 5, k1 = \"1e6 N/m\", phi_f = 0.05 }";
            formula(pair, [kp_over_k1, k1, phi_f]) = laws::luding(pair, kp_over_k1, k1, phi_f);
            given by [kp_over_k1, k1, phi_f];
            ends at ZeroForce;
            keys {
                /// Largest stiffness of the rebound over that of the loading, at least 1.
                kp_over_k1: Number, Positive, Role::number(None, (1.0, 1e6)).starting_at(5.0);
                /// Stiffness of the loading, > 0.
                k1: Stiffness, Positive, Role::STIFFNESS;
                /// Plasticity depth over the reduced radius, > 0.
                phi_f: Number, Positive, Role::number(Some(0.05), (1e-6, 1.0));
            }
        }
    };
}
