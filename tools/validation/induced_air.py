"""Air that a falling stream draws into an enclosed chute: Anderson's rule, and a balance of forces in one dimension."""

GRAVITY, AIR, VISCOSITY, STONE = 9.81, 1.2, 18e-6, 2650
SIDE = 0.3  # m, of the chute


def anderson(load=10, fall=2, size=0.02):
    """Velocity [m/s] in the open area of a chute: 10 (R S^2/D)^(1/3) ft/min of short tons/h and ft, from kg/s and m."""
    tons, foot = load * 3600 / 907.185, 0.3048
    return 10 * (tons * (fall / foot) ** 2 / (size / foot)) ** (1 / 3) * foot / 60


def balance(load=10, fall=2, size=0.02):
    """Velocity [m/s] at which the drag of single grains that fall through a uniform flow makes up for one velocity head."""
    low, high = 0.0, 20.0
    for _ in range(40):
        air = (low + high) / 2
        low, high = (air, high) if drag(load, fall, size, air) > SIDE**2 * 0.5 * AIR * air**2 else (low, air)
    return low


def drag(load, fall, size, air, step=1e-3):
    """Force [N] of the grains on the air, by Schiller and Naumann's law; they begin with 0.5 m/s."""
    speed, z, force = 0.5, 0.0, 0.0
    while z < fall:
        slip = speed - air
        re = max(abs(slip) * size * AIR / VISCOSITY, 1.0)
        law = 24 / re * (1 + 0.15 * re**0.687) if re < 1000 else 0.44
        slowed = 0.75 * law * AIR / (STONE * size) * slip * abs(slip)
        force += load * slowed * step
        speed += (GRAVITY - slowed) * step
        z += speed * step
    return force
