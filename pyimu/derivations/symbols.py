"""The symbols of the derivations: how each is written, its shape, its unit and what it means."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Symbol:
    """How a symbol is written, the ``shape`` of its casadi matrix, its unit and its meaning.

    A symbol without ``meaning`` is explained by its equation.
    """

    name: str
    latex: str
    shape: tuple[int, int] = (1, 1)
    unit: str = "1"
    meaning: str = ""

    @property
    def elsewhere(self) -> bool:
        """Whether the meaning only says in which other result the symbol is defined."""
        return self.meaning.startswith(("as in", "as for", "see"))


def _table(*symbols: Symbol) -> dict[str, Symbol]:
    return {s.name: s for s in symbols}


VECTOR, MATRIX = (3, 1), (3, 3)

SYMBOLS = _table(
    # attitude
    Symbol(
        "q_s",
        "q_s",
        (1, 1),
        "1",
        "scalar part of the attitude quaternion (body to world, Hamilton's product)",
    ),
    Symbol("q_v", r"\boldsymbol{q}_v", VECTOR, "1", "vector part of the attitude quaternion"),
    Symbol("q", r"\boldsymbol{q}", (4, 1), "1", "the quaternion, scalar first: `q_s` above `q_v`"),
    Symbol("q_dot", r"\dot{\boldsymbol{q}}", (4, 1), "1/s", "derivative of `q`"),
    Symbol("q_next", r"\boldsymbol{q}_{k+1}", (4, 1), "1", "the quaternion one period later"),
    Symbol("q_H", r"\boldsymbol{q}_H", (4, 1), "1", "the quaternion as the paper writes it"),
    Symbol("qH_next", r"\boldsymbol{q}_{H,k+1}", (4, 1), "1", "the same one period later"),
    Symbol("Xi", r"\Xi", (4, 3)),
    Symbol("Omega", r"\Omega", (4, 4)),
    Symbol("Omega_H", r"\Omega_H", (4, 4)),
    Symbol("P_H", "P_H", (4, 4)),
    Symbol("A", "A", MATRIX),
    Symbol("c", "c", (1, 1), "1", "as in the closed form of one step"),
    Symbol("psi", r"\boldsymbol{\psi}", VECTOR, "1", "as in the closed form of one step"),
    Symbol("omega", r"\boldsymbol{\omega}", VECTOR, "rad/s", "rate of the body, body axes"),
    Symbol("w", r"\omega", (1, 1), "rad/s", "magnitude of the rate"),
    Symbol("h", "h", (1, 1), "s", "sample period"),
    Symbol("I_3", "I", MATRIX, "1", "unit matrix (3, 3)"),
    Symbol("I_6", "I", (6, 6), "1", "unit matrix (6, 6)"),
    Symbol("O_3", "0", MATRIX, "1", "matrix of zeros (3, 3)"),
    Symbol("O_31", "0", VECTOR, "1", "column of zeros (3)"),
    # attitude error
    Symbol("a", "a", (1, 1), "1", "parameter of the generalised Rodrigues parameters, 0 to 1"),
    Symbol(
        "f",
        "f",
        (1, 1),
        "1",
        "scale factor of the generalised Rodrigues parameters; `f = a = 1` are the modified "
        "Rodrigues parameters",
    ),
    Symbol(
        "p",
        r"\boldsymbol{p}",
        VECTOR,
        "1",
        "generalised Rodrigues parameters, body axes; in rad where `s = 1`",
    ),
    Symbol("s", "s", (1, 1), "1", "share: `p` is `s` times the rotation vector, to second order"),
    Symbol("r", r"\boldsymbol{r}", VECTOR, "rad", "rotation vector"),
    Symbol("p_dot", r"\dot{\boldsymbol{p}}", VECTOR, "1/s", "derivative of `p`"),
    Symbol("x_dot", r"\dot{\boldsymbol{x}}", (6, 1)),
    Symbol("x", r"\boldsymbol{x}", (6, 1), "mixed", "error state: `p` above `b`"),
    Symbol(
        "omega_hat",
        r"\hat{\boldsymbol{\omega}}",
        VECTOR,
        "rad/s",
        "estimated rate against inertial space",
    ),
    Symbol(
        "delta_omega",
        r"\delta\boldsymbol{\omega}",
        VECTOR,
        "rad/s",
        "true rate less the estimated one",
    ),
    Symbol("b", r"\boldsymbol{b}", VECTOR, "rad/s", "gyro bias less its estimate"),
    Symbol(
        "eta_N",
        r"\boldsymbol{\eta}_N",
        VECTOR,
        "1/sqrt(Hz)",
        "white noise of unit two-sided density that drives the angle",
    ),
    Symbol(
        "eta_K",
        r"\boldsymbol{\eta}_K",
        VECTOR,
        "1/sqrt(Hz)",
        "white noise of unit two-sided density that drives the bias",
    ),
    Symbol("eta", r"\boldsymbol{\eta}", (6, 1), "1/sqrt(Hz)", "`eta_N` above `eta_K`"),
    Symbol("F", "F", (6, 6), "1/s", "as for the attitude error"),
    Symbol("G", "G", (6, 6), "1/sqrt(s)", "as for the attitude error"),
    Symbol("D_N", "D_N", MATRIX, "rad/sqrt(s)", "diagonal: angle random walk of each axis"),
    Symbol("D_K", "D_K", MATRIX, "rad/s/sqrt(s)", "diagonal: rate random walk of each axis"),
    # Earth and sensor
    Symbol("lat", r"\varphi", (1, 1), "rad", "latitude"),
    Symbol("omega_ie", r"\omega_{ie}", (1, 1), "rad/s", "the Earth's rate, 7.292115e-5 (WGS 84)"),
    Symbol(
        "omega_enu",
        r"\boldsymbol{\omega}_{ie}^{\mathrm{enu}}",
        VECTOR,
        "rad/s",
        "the Earth's rate in axes east, north, up",
    ),
    Symbol(
        "omega_nwu",
        r"\boldsymbol{\omega}_{ie}^{\mathrm{nwu}}",
        VECTOR,
        "rad/s",
        "the same in axes north, west, up",
    ),
    Symbol("R_nb", "R_{nb}", MATRIX),
    Symbol("b_dot", r"\dot{\boldsymbol{b}}", VECTOR),
    Symbol("nu", r"\nu"),
    Symbol("pi", r"\pi"),
    Symbol("Q_dot", r"\dot{Q}", (6, 6)),
    Symbol("M", "M", MATRIX, "1", "scale factor errors (diagonal) and misalignments"),
    Symbol("omega_m", r"\tilde{\boldsymbol{\omega}}", VECTOR, "rad/s", "measured rate"),
    Symbol("beta", r"\hat{\boldsymbol{\beta}}", VECTOR, "rad/s", "estimated gyro bias"),
    Symbol("omega_1", r"\hat{\boldsymbol{\omega}}_1", VECTOR, "rad/s", "its first order"),
    Symbol("e_1", r"\boldsymbol{e}_1", VECTOR, "rad/s", "error of that"),
    # process noise
    Symbol("k", "k", (1, 1), "1", "1, 2, ..., 7"),
    *(
        Symbol(
            f"psi_{k}",
            rf"\psi_{k}",
            (1, 1),
            f"s^{k}" if k != 1 else "s",
            "see the integrals of sine and cosine",
        )
        for k in (*range(1, 8), "k")
    ),
    *(Symbol(f"chi_{k}", rf"\chi_{k}") for k in (5, 7)),
    *(Symbol(f"m_{i}{j}", f"m_{{{i}{j}}}") for i in range(4) for j in range(i, 4)),
    Symbol("W", "W", MATRIX, "rad/s", "matrix of the cross product with `omega`"),
    Symbol("S", "S", (6, 6)),
    Symbol("N", "N", (1, 1), "rad/sqrt(s)", "angle random walk, root of its two-sided density"),
    Symbol(
        "K",
        "K",
        (1, 1),
        "rad/s/sqrt(s)",
        "rate random walk, root of the two-sided density of the bias's derivative",
    ),
    Symbol(
        "S_N", "S_N", MATRIX, "rad^2/s", "diagonal: square of the angle random walk of each axis"
    ),
    Symbol(
        "S_K", "S_K", MATRIX, "rad^2/s^3", "diagonal: square of the rate random walk of each axis"
    ),
    Symbol(
        "Phi",
        r"\Phi",
        (6, 6),
        "mixed",
        "transition matrix, `x` one period later is `Phi@x` and noise",
    ),
    Symbol("Phi_pp", r"\Phi_{pp}", MATRIX),
    Symbol("Phi_pb", r"\Phi_{pb}", MATRIX),
    Symbol("Q", "Q", (6, 6), "mixed", "covariance that a period adds to the error state"),
    Symbol(
        "Q_pp", "Q_{pp}", MATRIX, "rad^2", "covariance that a period adds to the attitude error `p`"
    ),
    Symbol(
        "Q_pb", "Q_{pb}", MATRIX, "rad^2/s", "covariance that it adds between `p` and the bias `b`"
    ),
    Symbol("Q_bb", "Q_{bb}", MATRIX, "rad^2/s^2", "covariance that it adds to `b`"),
    # Gauss-Markov
    Symbol(
        "g",
        "g",
        (1, 1),
        "rad/s/sqrt(s)",
        "root of the two-sided density of the noise that drives the bias, q of the effect "
        "gauss_markov",
    ),
    Symbol(
        "tau", r"\tau", (1, 1), "s", "correlation time of the bias, tau of the effect gauss_markov"
    ),
    Symbol("kappa", r"\kappa", (1, 1), "1/s", "decay of the bias"),
    Symbol("E", "E"),
    Symbol("V", "V"),
    Symbol("c_w", r"c_\omega"),
    Symbol("s_w", r"s_\omega"),
    Symbol("I_0", "I_0"),
    Symbol("I_1", "I_1"),
    Symbol("J_0", "J_0"),
    Symbol("J_c", "J_c"),
    Symbol("J_s", "J_s"),
    Symbol("g_1", "g_1", (1, 1), "rad/s/sqrt(s)", "strength of the first process"),
    Symbol("g_2", "g_2", (1, 1), "rad/s/sqrt(s)", "strength of the second process"),
    Symbol("tau_1", r"\tau_1", (1, 1), "s", "correlation time of the first process"),
    Symbol("tau_2", r"\tau_2", (1, 1), "s", "correlation time of the second process"),
    *(Symbol(f"{n}_{i}", f"{n}_{i}") for n in "Evcd" for i in (1, 2)),
)
