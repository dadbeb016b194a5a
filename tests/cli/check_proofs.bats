#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# impinge check: bounds are proved from formulas, or refuted by counterexamples.

load ../support/check_helper

wavy='u; cos(3*u)*sin(2*v); v+sin(u+2*t)'

# disproves LIAR TEXT: what the truthful formula refutes of it.
disproves() {
    run -6 "$IMPINGE" check "$liars/$1.so" --only proof --formula "$wavy" --effort "${3-0.1}"
    echo "$output"
    [[ $output == *"FAIL  proof "*": $2"*": by the formula "*" is surely in ["*"refuted"* ]]
}

@test "types that take their formula as text are proved" {
    local type
    for type in formula 'formula x=u*exp(-u*v) y=sqrt(1+v*v) z=u*t' \
        'map-formula x=x*cos(t)-y*sin(t) y=x*sin(t)+y*cos(t)' \
        'motion-formula offset=["0","0.1*t^2","0.4*cos(9*t)+sqrt(1.44-(0.4*sin(9*t))^2)"]' \
        'motion-formula angle=sin(3*t)*k axis=1,2,3 constants={"k":2,"mm":3,"m_C":5}'; do
        run -0 "$IMPINGE" check "$type" --effort 0.1
        [[ $output == *"  pass  proof "*" claims over "*" regions are proved"*"  proved("*", 1): "* ]]
    done
}

# follows TYPE X Y Z: what the type claims follows from the formula, but for one claim in a hundred
# at most, where there is no slack to prove it with.
follows() {
    run -0 "$IMPINGE" check "$1" --only proof --formula "$2; $3; $4" --effort 0.05 --json
    echo "$1: $output"
    json '.types[0].proof | .claims > 1000 and .proved >= 0.99 * .claims'
}

@test "tight and right bounds are proved, every claim of them or nearly" {
    local r='(major_radius + minor_radius*cos(v))'
    run -0 "$IMPINGE" check sphere --only proof --formula \
        'center0 + radius*cos(v)*cos(u); center1 + radius*cos(v)*sin(u); center2 + radius*sin(v)'
    [[ $output == *"pass  proof        all "*"  proved("* ]]
    # Where v is small the remainder of its sine is nearly all that is left out.
    run -0 "$IMPINGE" check torus --only proof --formula "$r*cos(u); $r*sin(u); minor_radius*sin(v)" --json
    json '.types[0].proof | .claims > 100000 and .proved >= 0.9999 * .claims'
}

@test "our types are what they say they are, and their bounds follow from it" {
    local r
    follows 'sphere radius=2 center=0,0,1' '2*cos(v)*cos(u)' '2*cos(v)*sin(u)' '1+2*sin(v)'
    r='(major_radius + minor_radius*cos(v))'
    follows torus "$r*cos(u)" "$r*sin(u)" 'minor_radius*sin(v)'
    follows $'torus\tmajor_radius=+2.\tminor_radius=.5' "$r*cos(u)" "$r*sin(u)" 'minor_radius*sin(v)'
    follows 'ellipsoid radii=1,2,3 center=.1,-.2,.3' 'center0 + radii0*cos(v)*cos(u)' \
        'center1 + radii1*cos(v)*sin(u)' 'center2 + radii2*sin(v)'
    follows cylinder 'radius*cos(u)' 'radius*sin(u)' 'height*v'
    follows cone '(1-v)*radius*cos(u)' '(1-v)*radius*sin(u)' 'height*v'
    follows 'plane origin=-5,-5,0.3 edge_u=10,0.7,0 edge_v=0.1,10,-3' '-5+10*u+.1*v' \
        '-5+.7*u+10*v' '.3-3*v'
    follows 'ripple direction=1,1 size=4,4' u v '.1*sin(2*pi*((u+v)/sqrt(2)-t))'
    r='(1 + exp(-((u-3)^2+v^2)/.36) + exp(-((u-3-2*pi)^2+v^2)/.36) + exp(-((u-3+2*pi)^2+v^2)/.36))'
    follows 'spike width=.6 spikes=[[3,0]]' "$r*cos(v)*cos(u)" "$r*cos(v)*sin(u)" "$r*sin(v)"
    follows 'segment points=[[0,0,0],[2,0,.7]] velocities=[[0,.3,0],[0,1,0]]' '2*u' \
        '(1-u)*.3*t+u*t' '.7*u'
    follows 'triangle points=[[0,0,0],[1,0,0],[.3,1,0]] velocities=[[0,0,1],[.7,0,1],[0,0,2]]' \
        'u*(1+.7*t+v*(.3-1-.7*t))' 'u*v' 't+u*v*t'
}

@test "our maps are what they say they are, and their bounds follow from it" {
    local a m='(x+y+z)/3'
    follows 'translate velocity=1,.3,0' 'x+t' 'y+.3*t' z
    follows 'rotate axis=1,1,1 rate=1' "$m + cos(t)*(x-$m) + sin(t)*(z-y)/sqrt(3)" \
        "$m + cos(t)*(y-$m) + sin(t)*(x-z)/sqrt(3)" "$m + cos(t)*(z-$m) + sin(t)*(y-x)/sqrt(3)"
    follows 'motion-formula angle=t*mm_d axis=1,1,1 offset=["0","t*t","1"] constants={"mm_d":1}' \
        "$m + cos(t)*(x-$m) + sin(t)*(z-y)/sqrt(3)" \
        "$m + cos(t)*(y-$m) + sin(t)*(x-z)/sqrt(3) + t^2" \
        "$m + cos(t)*(z-$m) + sin(t)*(y-x)/sqrt(3) + 1"
    follows 'scale factors=[[1],[.5]]' 'x*(1+.5*t)' 'y*(1+.5*t)' 'z*(1+.5*t)'
    follows 'screw pitch=.5 rate=6' 'cos(6*t)*x-sin(6*t)*y' 'sin(6*t)*x+cos(6*t)*y' 'z+1.5*t/pi'
    a='(1 - .5*t*clamp((z+1)/2, 0, 1))'
    follows 'taper end=[1,-.5]' "x*$a" "y*$a" z
    follows 'tolerance offset=.5 angle=.1' x y z # in the middle of its parts
    follows 'twist rate=.5' 'cos(.5*z)*x-sin(.5*z)*y' 'sin(.5*z)*x+cos(.5*z)*y' z
    follows 'wave amplitude=0,0,.1 wave_vector=6,0,0' x y 'z+.1*sin(6*x-6*t)'
    a='clamp(y,-1,1)'
    follows 'bend curvature=.5' x "2*sin(.5*$a) - z*sin(.5*$a) + (y-$a)*cos(.5*$a)" \
        "2*(1-cos(.5*$a)) + z*cos(.5*$a) + (y-$a)*sin(.5*$a)"
}

@test "what a proof refutes is a counterexample to what the formula says" {
    disproves liar_corners 'the rate of y by u'
    disproves liar_grid 'the rate of y by u'
    disproves liar_time 'the rate of z by t, 0, over'
    disproves liar_sign 'the remainder of y' 1
    disproves liar_remainder 'the remainder of y'
    disproves liar_range 'the range of z'
    disproves liar_percent 'the rate of x by u, 0.98999999999999999' 1
    run -6 "$IMPINGE" check "$liars/liar_error.so" --only proof --formula "$wavy" --effort 0.1
    [[ $output == *"with the error 0 at "*"surely "*" off"* ]]
}

@test "a domain that is not the one stated is exposed, and ends that almost meet are pointed out" {
    local whole='0,2*pi; -1,2'
    run -0 "$IMPINGE" check sphere --only domain --domain '0,2*pi; -pi/2,pi/2; -1,3'
    [[ $output == *"pass  domain       as stated"* ]]
    blamed stated domain_too_short --only domain --domain "$whole"
    [[ $output == *"v ends at 1, but is said to end at 2"*"again: impinge check "*"--domain '$whole'"* ]]
    run -0 "$IMPINGE" check period_of_6_28 --plugin-path . --only domain
    [[ $output == *"note  domain "*"the ends of u, 0 and 6.2800000000000002, almost meet"*", 1 noted"* ]]
    blamed stated period_of_6_28 --only domain --domain "$whole"
    run -0 "$IMPINGE" check period_of_6_28 --plugin-path . --only domain --json
    valid check
    json '.verdict == "pass" and .types[0].checks[0].verdict == "note"'
    fails 2 '--domain cannot be read: expected LO,HI; LO,HI of u and v' \
        "$IMPINGE" check sphere --domain '0,1'
    fails 2 "'radios' is neither a variable () nor" "$IMPINGE" check sphere --domain '0,radios;0,1'
}

@test "a formula may name parameters, and is compared with each stage" {
    local bowl='center0+radius*cos(v)*cos(u); center1+radius*cos(v)*sin(u); center2+radius*sin(v)'
    run -0 "$IMPINGE" check sphere --only proof --effort 0.05 --formula "$bowl"
    [[ $output == *"as: sphere radius=2"*"as: sphere"*"  pass  proof "* ]]
    run -6 "$IMPINGE" check 'sphere radius=2' --only proof --effort 0.05 \
        --formula "${bowl//radius/2.0000001}"
    [[ $output == *"again: impinge check "*" --formula "*" --effort 0.05 --only proof"*refuted* ]]
}

@test "a formula that cannot be read is told of, with its place, and nothing is checked" {
    run -2 "$IMPINGE" check sphere --only proof --formula 'u;v;radios'
    [[ $output == *"cannot be read: 'radios', character 7: 'radios' is neither a variable (uvt) nor"* ]]
    [[ $output != *"pass  "* ]]
    run -2 "$IMPINGE" check sphere --json --formula 'u;v'
    [[ $output == *"expected three formulas with ';' between them"* ]]
}

@test "a formula may name booleans, and elements of lists that not all instances have" {
    fails 2 "'hat' is neither a variable (xyzt) nor a constant; these are pi, e, times0 ... times2, " \
        "$IMPINGE" check keyframes --formula 'x; y; z*hat'
    [[ $stderr == *', hold' ]]
    run -0 "$IMPINGE" check segment --only proof --effort 0.05 --formula '2*u; u*t*velocities4; 0'
    [[ $output == *'as: segment'*'as: segment'*'  pass  proof        all '* ]]
}

@test "parameters that are wrong are the user's fault, not the plugin's" {
    run -4 "$IMPINGE" check 'sphere radius=-1'
    [[ $output == *"'sphere radius=-1': surface: radius: got -1, must be > 0"* ]]
    [[ $output != *FAIL* ]]
}

@test "a type's own formula proves its bounds, part by part" {
    run -0 "$IMPINGE" check sphere --only proof --effort 0.2
    [[ $output == *"pass  proof        all "*"  proved("* ]]
    run -0 "$IMPINGE" check 'rotate times=[0,1,2] angles=[0,1,0.5]' --only proof --effort 0.2
    [[ $output == *"pass  proof "*" claims over "* ]]
}

@test "without a formula there is no proof" {
    run -0 "$IMPINGE" check "$liars/liar_truthful.so" --only proof
    [[ $output == *"skip  proof "*"no formula is known; state it with --formula "* ]]
}
