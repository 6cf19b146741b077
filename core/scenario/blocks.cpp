// SPDX-License-Identifier: Apache-2.0
#include "scenario/blocks.hpp"

namespace dust::scenario {

namespace dimension = sdk::dimension;
using sdk::ParameterSchema;
using sdk::SchemaOf;

const ParameterSchema& GeneralBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<GeneralBlock> s;
    s.text(&GeneralBlock::name, "name",
           "Name of the scenario and of its output folder; without it, the file's stem.")
        .optional();
    s.integer(&GeneralBlock::seed, "seed", "Seed of all random numbers.").at_least(0).optional();
    s.vector(&GeneralBlock::gravity, "gravity", dimension::acceleration,
             "Acceleration of gravity; [0, 0, 0] for none.");
    return s.build();
  }();
  return made;
}

const ParameterSchema& TimeBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<TimeBlock> s;
    s.number(&TimeBlock::end, "end", dimension::time, "Time at which the run ends.").above(0);
    s.number(&TimeBlock::fluid_step, "fluid_step", dimension::time,
             "Step of the fluid, of emission and of the sensors.")
        .above(0);
    s.number(&TimeBlock::output_every, "output_every", dimension::time,
             "Time between frames, a multiple of fluid_step.")
        .above(0);
    s.number(&TimeBlock::checkpoint_every, "checkpoint_every", dimension::time,
             "Time between checkpoints, a multiple of fluid_step; 0 writes one with every frame.")
        .at_least(0)
        .optional();
    s.number(&TimeBlock::keep_every, "keep_every", dimension::time,
             "Time between checkpoints that are kept for start_from, a multiple of fluid_step; 0 "
             "keeps the newest alone.")
        .at_least(0)
        .optional();
    s.number(&TimeBlock::dem_step, "dem_step", dimension::time,
             "Fixed step of the grains; 0 derives one per size class.")
        .at_least(0)
        .optional();
    s.number(&TimeBlock::expected_speed, "expected_speed", dimension::velocity,
             "Largest approach speed of grains, for their steps; 0 takes that of the fastest body, "
             "or of the fastest grain as it is let in, at least 0.5 m/s.")
        .at_least(0)
        .optional();
    s.text(&TimeBlock::rates, "rates",
           "Whether each size class has its own step or the finest one's holds for all.")
        .one_of({"several", "single"})
        .optional();
    return s.build();
  }();
  return made;
}

const ParameterSchema& DomainBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<DomainBlock> s;
    s.vector(&DomainBlock::min, "min", dimension::length, "Lower corner of the domain.");
    s.vector(&DomainBlock::max, "max", dimension::length, "Upper corner of the domain.");
    return s.build();
  }();
  return made;
}

const ParameterSchema& SideBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<SideBlock> s;
    s.text(
         &SideBlock::grains, "grains",
         "What grains meet: open (they leave), wall, or periodic. Dust of a field leaves where the "
         "air passes, and settles elsewhere.")
        .one_of({"open", "wall", "periodic"});
    s.text(&SideBlock::material, "material", "Material of a wall.")
        .refers_to(sdk::Refers::material)
        .optional();
    return s.build();
  }();
  return made;
}

const ParameterSchema& MaterialBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<MaterialBlock> s;
    s.number(&MaterialBlock::density, "density", dimension::density, "Density of the solid.")
        .symbol("rho")
        .above(0)
        .usual(10, 25000);
    s.number(&MaterialBlock::young_modulus, "young_modulus", dimension::pressure,
             "Modulus of elasticity.")
        .symbol("E")
        .above(0)
        .usual(0, 1.3e12);
    s.number(&MaterialBlock::poisson_ratio, "poisson_ratio", dimension::none, "Poisson's ratio.")
        .symbol("nu")
        .above(-1)
        .at_most(0.5);
    s.number(&MaterialBlock::coarse_graining, "coarse_graining", dimension::none,
             "Diameter of a grain over that of the smaller grains it stands for: the fluid acts as "
             "on these, the contacts see the grain itself.")
        .symbol("l")
        .at_least(1)
        .optional();
    s.numbers(&MaterialBlock::dust_load, "dust_load", dimension::none,
              "Dust that grains bring along, part of their mass: a share for each class of "
              "dust.field.")
        .symbol("s")
        .at_least(0)
        .at_most(1)
        .optional();
    s.number(&MaterialBlock::moisture, "moisture", dimension::none,
             "Water over dry solids, by mass (1 % or 0.01): binds the dust as the law of "
             "dust.liberation says, also what none counts as, and is the liquid of a liquid_bridge "
             "that gives no volume of its own.")
        .symbol("M")
        .at_least(0)
        .at_most(1)
        .optional();
    return s.build();
  }();
  return made;
}

const ParameterSchema& InteractionBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<InteractionBlock> s;
    s.texts(&InteractionBlock::between, "between", "The two materials that meet.")
        .refers_to(sdk::Refers::material);
    return s.build();
  }();
  return made;
}

const ParameterSchema& FrameBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<FrameBlock> s;
    s.vector(&FrameBlock::origin, "origin", dimension::length, "Point about which all turn.");
    s.vector(&FrameBlock::axis, "axis", dimension::none, "Direction of the axis, right-handed.");
    s.number(&FrameBlock::angle, "angle", dimension::angle, "Angle turned by.").optional();
    return s.build();
  }();
  return made;
}

const ParameterSchema& PlacedBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<PlacedBlock> s;
    s.boolean(&PlacedBlock::enabled, "enabled", "Whether it takes part; it is checked anyway.")
        .optional();
    s.text(&PlacedBlock::frame, "frame", "Frame it turns with; without it, the domain's.")
        .optional();
    s.text(&PlacedBlock::material, "material", "Its material.").refers_to(sdk::Refers::material);
    return s.build();
  }();
  return made;
}

const ParameterSchema& BodyBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<BodyBlock> s;
    s.text(&BodyBlock::group, "group", "Group it belongs to: sensors add up the bodies of a group.")
        .optional();
    return s.build();
  }();
  return made;
}

const ParameterSchema& RemovalBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<RemovalBlock> s;
    s.number(&RemovalBlock::at, "at", dimension::time, "Time at which it is taken away.")
        .at_least(0)
        .optional();
    s.number(&RemovalBlock::kinetic_energy_per_grain, "when_kinetic_energy_per_grain_below",
             dimension::energy,
             "It is taken away once the mean kinetic energy of all grains is below this.")
        .above(0)
        .optional();
    s.number(&RemovalBlock::after, "after", dimension::time,
             "The energy is not looked at before this time.")
        .at_least(0)
        .optional();
    return s.build();
  }();
  return made;
}

const ParameterSchema& SuctionBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<SuctionBlock> s;
    s.number(&SuctionBlock::flow, "flow", dimension::volume_flow,
             "Volume flow of the fluid into the body; negative: it blows.")
        .symbol("Q");
    s.vector(&SuctionBlock::min, "min", dimension::length,
             "Lower corner of a box: the part of the body's surface in it is the opening.");
    s.vector(
        &SuctionBlock::max, "max", dimension::length,
        "Upper corner of the box. Both in the body's frame; a flat box on a flat face is fine.");
    s.numbers(&SuctionBlock::times, "times", dimension::time, "Times of the factors.").optional();
    s.numbers(&SuctionBlock::factors, "factors", dimension::none,
              "What flow is multiplied by at each of times; straight lines between.")
        .symbol("g")
        .optional();
    return s.build();
  }();
  return made;
}

const ParameterSchema& SensorBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<SensorBlock> s;
    s.boolean(&SensorBlock::enabled, "enabled", "Whether it takes part; it is checked anyway.")
        .optional();
    return s.build();
  }();
  return made;
}

const ParameterSchema& AuditBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<AuditBlock> s;
    s.boolean(&AuditBlock::energy, "energy",
              "Keeps account of the energy of the grains: kinetic, elastic, work of gravity, walls "
              "and fluid, losses by damping, friction and rolling. Grains below an eighth "
              "of the largest one need time.rates: single.")
        .optional();
    return s.build();
  }();
  return made;
}

const ParameterSchema& DustBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<DustBlock> s;
    s.number(&DustBlock::finer_than, "finer_than", dimension::length,
             "Grains of a smaller diameter are dust; of coarse-grained materials that of the "
             "grains they stand for. 0 = any size.")
        .symbol("d")
        .at_least(0)
        .optional();
    s.numbers(&DustBlock::classes, "classes", dimension::length,
              "Diameters that are dust; none given = all.")
        .symbol("d")
        .above(0)
        .optional();
    s.texts(&DustBlock::materials, "materials", "Materials that are dust; none given = all.")
        .refers_to(sdk::Refers::material)
        .optional();
    s.texts(&DustBlock::hoods, "hoods",
            "Bodies with suction and sides with a hood that are there to catch dust; none given = "
            "all.")
        .optional();
    s.number(&DustBlock::steady_after, "steady_after", dimension::time,
             "Time from which the rates of the dust field are means, when the stream has become "
             "steady; 0 = the middle of the run, of a branch the middle of what it adds.")
        .at_least(0)
        .optional();
    s.number(&DustBlock::fall_height, "fall_height", dimension::length,
             "Height that the load falls from, for the rules of practice beside the results "
             "(VDI 3790-3, induced air), which need it; 0 = not known.")
        .symbol("H")
        .at_least(0)
        .optional();
    s.number(&DustBlock::open_area, "open_area", dimension::area,
             "Open area at the upstream end of a chute, through which a falling load draws air "
             "in, for the rule of induced air; needs fall_height; 0 = not known.")
        .symbol("A")
        .at_least(0)
        .optional();
    return s.build();
  }();
  return made;
}

const ParameterSchema& DustFieldBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<DustFieldBlock> s;
    s.numbers(&DustFieldBlock::classes, "classes", dimension::length,
              "Diameters of the dust, ascending; each is a concentration of its own.")
        .symbol("d")
        .above(0);
    s.text(&DustFieldBlock::material, "material", "Material whose density the dust has.")
        .refers_to(sdk::Refers::material);
    s.number(&DustFieldBlock::schmidt_number, "schmidt_number", dimension::none,
             "Eddy viscosity over the turbulent diffusivity of dust.")
        .symbol("Sc")
        .above(0)
        .optional();
    s.boolean(&DustFieldBlock::inertia, "inertia",
              "Whether dust drifts off where the gas turns or speeds up, to first order in its "
              "response time.")
        .optional();
    s.boolean(&DustFieldBlock::scavenging, "scavenging",
              "Whether grains catch the dust that they meet on their way: all that hits them stays "
              "on them.")
        .optional();
    s.boolean(&DustFieldBlock::resuspension, "resuspension",
              "Whether the wind takes dust off walls and bodies again where its shear is above the "
              "threshold.")
        .optional();
    sdk::declare_wind_erosion(s);
    s.text(&DustFieldBlock::deposition, "deposition",
           "What brings dust to walls and bodies: settling alone, or turbulence, too, as to smooth "
           "walls after Lai and Nazaroff.")
        .one_of({"settling", "lai_nazaroff"})
        .optional();
    return s.build();
  }();
  return made;
}

const ParameterSchema& DustCloudBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<DustCloudBlock> s;
    s.vector(&DustCloudBlock::min, "min", dimension::length, "Lower corner of the cloud.");
    s.vector(&DustCloudBlock::max, "max", dimension::length, "Upper corner of the cloud.");
    s.numbers(&DustCloudBlock::concentration, "concentration", dimension::density,
              "Dust per volume of fluid at the start, one number per class.")
        .symbol("c")
        .at_least(0);
    return s.build();
  }();
  return made;
}

const ParameterSchema& FeedZoneBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<FeedZoneBlock> s;
    s.vector(&FeedZoneBlock::min, "min", dimension::length,
             "Lower corner of the box in which nothing comes off grains, for what they fall there "
             "is the scenario's feed and no part of the plant.");
    s.vector(&FeedZoneBlock::max, "max", dimension::length, "Upper corner of the box.");
    return s.build();
  }();
  return made;
}

const ParameterSchema& DustSourceBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<DustSourceBlock> s;
    s.vector(&DustSourceBlock::min, "min", dimension::length,
             "Lower corner of the box in which dust is set free.");
    s.vector(&DustSourceBlock::max, "max", dimension::length, "Upper corner of the box.");
    s.numbers(&DustSourceBlock::mass_flow, "mass_flow", dimension::mass_flow,
              "Dust set free in the whole box, one number per class.")
        .symbol("m")
        .at_least(0);
    s.number(&DustSourceBlock::begin, "begin", dimension::time, "Time from which it flows.")
        .at_least(0)
        .optional();
    s.number(&DustSourceBlock::end, "end", dimension::time, "Time at which it ends.")
        .at_least(0)
        .optional();
    return s.build();
  }();
  return made;
}

const ParameterSchema& ReferenceBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<ReferenceBlock> s;
    s.text(&ReferenceBlock::quantity, "quantity",
           "Figure of a sensor that is held against the number: sensors.NAME.FIGURE.");
    s.text(&ReferenceBlock::source, "source", "Where the number comes from.");
    return s.build();
  }();
  return made;
}

const ParameterSchema& ReferenceCurveBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<ReferenceCurveBlock> s;
    s.text(&ReferenceCurveBlock::sensor, "sensor", "Sensor whose curve it is drawn behind.");
    s.text(&ReferenceCurveBlock::source, "source", "Where the curve comes from.");
    return s.build();
  }();
  return made;
}

const ParameterSchema& FluidBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<FluidBlock> s;
    s.vector(&FluidBlock::cells, "cells", dimension::none, "Number of cells along x, y and z.")
        .at_least(1)
        .at_most(100000);
    s.number(&FluidBlock::density, "density", dimension::density, "Density of the fluid.")
        .symbol("rho")
        .above(0)
        .usual(0.05, 25000);
    s.number(&FluidBlock::viscosity, "viscosity", dimension::dynamic_viscosity,
             "Dynamic viscosity of the fluid.")
        .symbol("mu")
        .above(0)
        .usual(1e-6, 1000);
    s.text(&FluidBlock::momentum_set, "momentum_set",
           "Form of the momentum equation: set I, II or III.")
        .one_of({"I", "II", "III"})
        .optional();
    s.vector(&FluidBlock::initial_velocity, "initial_velocity", dimension::velocity,
             "Velocity of the fluid at the start.")
        .optional();
    s.number(&FluidBlock::pressure_tolerance, "pressure_tolerance", dimension::none,
             "Residual of the pressure equation relative to its right side.")
        .above(0)
        .below(1)
        .optional();
    s.number(&FluidBlock::largest_cfl, "largest_cfl", dimension::none,
             "Largest Courant number; the fluid sub-steps to stay below.")
        .symbol("CFL")
        .above(0)
        .at_most(1)
        .optional();
    return s.build();
  }();
  return made;
}

const ParameterSchema& RegionBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<RegionBlock> s;
    s.vector(&RegionBlock::min, "min", dimension::length, "Lower corner of the region.");
    s.vector(&RegionBlock::max, "max", dimension::length, "Upper corner of the region.");
    s.number(&RegionBlock::density, "density", dimension::density, "Density of the fluid there.")
        .symbol("rho")
        .above(0)
        .usual(0.05, 25000);
    s.number(&RegionBlock::viscosity, "viscosity", dimension::dynamic_viscosity,
             "Dynamic viscosity of the fluid there.")
        .symbol("mu")
        .above(0)
        .usual(1e-6, 1000);
    return s.build();
  }();
  return made;
}

const ParameterSchema& CouplingBlock::schema() {
  static const ParameterSchema made = [] {
    SchemaOf<CouplingBlock> s;
    s.boolean(&CouplingBlock::one_way, "one_way",
              "Whether the grains feel the fluid but the fluid does not feel the grains.")
        .optional();
    s.text(&CouplingBlock::self_disturbance, "self_disturbance",
           "Whether what a grain does to the fluid by itself, its own void fraction, wake and "
           "pressure, is taken off before its drag is found: where it is above 1 % (auto), for "
           "all grains (on), for none (off).")
        .one_of({"auto", "on", "off"})
        .optional();
    s.boolean(&CouplingBlock::correct_disturbance_correction, "correct_own_disturbance",
              "Older name: true is `self_disturbance: on`, false `off`. Without effect beside it.")
        .optional();
    s.boolean(&CouplingBlock::overlap, "overlap",
              "Whether the fluid's step and the grains' cycle run at the same time: the grains see "
              "the fluid of the step before. Saves time on several cores; first order in the fluid "
              "step.")
        .optional();
    s.texts(
         &CouplingBlock::resolved, "resolved",
         "Materials whose grains are resolved: the fluid meets their surfaces (markers of an "
         "immersed boundary) instead of a drag law. Each needs 8 cells or more across, and bodies "
         "near it a cell's thickness; drag, voidage and fluid_forces are for the grains of the "
         "other materials.")
        .refers_to(sdk::Refers::material)
        .optional();
    return s.build();
  }();
  return made;
}

}  // namespace dust::scenario
