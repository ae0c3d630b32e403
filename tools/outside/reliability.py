"""The reliability diagram, as test/exam/reliability.h draws it: names by what was stated, and the share that was right."""

from math import sqrt

LEAST = (0.0, 0.5, 0.8, 0.95, 1.0)
Z90 = 1.6448536  # standard deviations: 5 % lie beyond on either side


def interval(right: int, of: int) -> tuple[float, float]:
    """90 % of the shares that `right` of `of` may stand for: Wilson 1927, score interval."""
    p, z2 = right / of, Z90 ** 2
    middle = (p + z2 / (2 * of)) / (1 + z2 / of)
    half = Z90 * sqrt(p * (1 - p) / of + z2 / (4 * of * of)) / (1 + z2 / of)
    return max(middle - half, 0.0), min(middle + half, 1.0)


def table(stated: list[tuple[float | None, bool]]) -> str:
    """Each name's probability, None where there is none, and whether it was right."""
    lines = ["  stated           mean       right            90 % interval"]
    for i, (least, most) in enumerate(zip(LEAST, LEAST[1:])):
        own = [(p, right) for p, right in stated if p is not None and least <= p and (p < most or i == len(LEAST) - 2)]
        line = f"  {least:<4g} to {most:<4g}"
        if not own:
            lines.append(line + "         -    0/0")
            continue
        right, of = sum(r for _, r in own), len(own)
        low, high = interval(right, of)
        lines.append(line + f"     {sum(p for p, _ in own) / of:.3f} {right:4}/{of:<4} {100 * right / of:5.1f} %   " +
                     f"{100 * low:5.1f} to {100 * high:5.1f} %")
    lines.append(f"  names without a probability: {sum(p is None for p, _ in stated)}")
    return "\n".join(lines)
