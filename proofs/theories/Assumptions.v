(** The axioms behind the main theorems. *)
From Secant Require Import Directions Replay Dense Refute Everywhere.
Print Assumptions contraction.
Print Assumptions attractor_equation.
Print Assumptions base_points.
Print Assumptions ball.
Print Assumptions leads_simple.
Print Assumptions leads_semisimple.
Print Assumptions leads_block.
Print Assumptions directed_intro.
Print Assumptions limit_intro.
Print Assumptions limit_parallel.
Print Assumptions no_common_tangent.
Print Assumptions one_direction.
Print Assumptions two_directions.
Print Assumptions directed_inside.
Print Assumptions tangent_everywhere.
Print Assumptions regular_ok.
Print Assumptions cusp_ok.
Print Assumptions corner_ok.
Print Assumptions no_tangent_ok.
Print Assumptions regular_levels.
Print Assumptions cusp_levels.
Print Assumptions cones_ok.
