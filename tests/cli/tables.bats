#!/usr/bin/env bats
# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# Tables of motions in files: every row counts, or says why it does not.

load ../support/cli_helper

# moves MAP: a ball at rest, and another that the map moves, whose table is table.csv.
moves() {
    run "${@:2}" "$IMPINGE" pair sphere "sphere center=9,0,0 ! $1" --json
}

# refuses TABLE TEXT [MAP]: the table is an error, which says where and what.
refuses() {
    # shellcheck disable=SC2059 # the table is written with \n
    printf "$1" >table.csv
    fails 4 "$2" "$IMPINGE" pair sphere "sphere center=9,0,0 ! ${3-translate file=table.csv}"
}

@test "a first row that holds a number is no head" {
    refuses '0,0,0,\n1,0,0,0\n' "'table.csv' line 1 column 4: found nothing, allowed is a number"
    refuses '0,nan,0,0\n1,0,0,0\n' "'table.csv' line 1 column 2: found 'nan', allowed is a number"
    refuses 'inf,nan,-inf,nan\n1,0,0,0\n2,0,0,0\n' "line 1 column 1: found 'inf'"
    refuses '0,1.0 mm,0,0\n1,0,0,0\n' "line 1 column 2: found '1.0 mm', allowed is a number"
    refuses '0 s,1 mm,0 mm,0 mm\n1,0,0,0\n2,0,0,0\n' "line 1 column 1: found '0 s'"
    refuses 't,1,y,z\n1,0,0,0\n2,0,0,0\n' "line 1 column 1: found 't', allowed is a number"
    refuses ',,,\n1,0,0,0\n2,0,0,0\n' "line 1 column 1: found nothing"
}

@test "every cell of every row is a number, used or not" {
    refuses 't,x,y,z\n0,0,0,0\n1,0,0,0 \n2,,0,0\n' "line 4 column 2: found nothing"
    refuses 't,x,y,z,note\n0,0,0,0,1\n1,0,0,0,slow\n' "line 3 column 5: found 'slow'"
    refuses 't,x,y,z\n0,0,0,0\n1,0,0,0,\n' "line 3 has 5 columns, line 1 has 4"
    refuses 't,x,y,z\n0,0,0,0\n1,0,0\n' "line 3 has 3 columns, line 1 has 4"
    refuses 't,x,y,z\n0,0,0,0\n1,0,0,1e999\n' "line 3 column 4: found '1e999'"
    refuses 't,x,y,z\n0,0,0,0\n,,,\n' "line 3 column 1: found nothing"
}

@test "semicolons and tabs part cells where they do so throughout, and decimals have a point" {
    refuses '0;1,5;0;0\n1;0;0;0\n' "line 1 column 2: found '1,5', allowed is a number; decimals have a point"
    refuses 't;x;y;z\n0;0;0;0\n1,0,0,0\n' "line 3 has 1 column, line 1 has 4 between semicolons"
    refuses 't\tx\ty\tz\n0\t0\t0\t0\n1;0;0;0\n' "line 3 has 1 column, line 1 has 4 between tabs"
    printf 't,x,y,z\n0,0,0,0\n1,-9,0,0\n' >table.csv
    moves 'translate file=table.csv' -0
    local t
    t=$(jq .t <<<"$output")
    for separator in ';' '\t' ' ; '; do
        # shellcheck disable=SC2059
        printf "t,x,y,z\n0,0,0,0\n1,-9,0,0\n" | sed "s/,/$separator/g" >table.csv
        moves 'translate file=table.csv' -0
        json ".t == $t"
    done
    printf '\xEF\xBB\xBF"t","x","y","z"\r\n"0","0","0","0"\r\n1,-9,0,0\r\n' >table.csv
    moves 'translate file=table.csv columns=["x","y","z"]' -0
    json ".t == $t"
}

@test "columns are found by name once, without their units, or by number" {
    refuses 't,q,q\n0,0,0\n1,1,1\n' "column/0: 'q' names columns 2 and 3 of 'table.csv'" 'rotate file=table.csv column=q'
    refuses 't,q,r\n0,0,0\n1,1,1\n' "'p' is no column of 'table.csv'; it has t, q, r" 'rotate file=table.csv column=p'
    refuses '0,0,0\n1,1,1\n' "'p' is no column of 'table.csv'; it has no head, and columns 1 to 3" \
        'rotate file=table.csv column=p'
    refuses 't,q,r\n0,0,0\n1,1,1\n' "'4' is no column of 'table.csv'; it has t, q, r" 'rotate file=table.csv column="4"'
    refuses 't,x\n0,0\n1,1\n' "'table.csv' has 2 columns; 4 are needed"
}

@test "angles are in degrees where a head or a parameter says so" {
    printf 't,j\n0,0\n1,1.5707963267948966\n' >table.csv
    moves 'rotate file=table.csv ! translate offset=[[0,-8.5,0]]' -0
    json '.verdict == "contact"'
    local t
    t=$(jq .t <<<"$output")
    for head in 't,j [deg]' 't [s],"j (deg)"' 't,j [°]'; do
        printf '%s\n0,0\n1,90\n' "$head" >table.csv
        moves 'rotate file=table.csv column=j ! translate offset=[[0,-8.5,0]]' -0
        json ".t - $t | fabs < 1e-12"
    done
    printf 't,j\n0,0\n1,90\n' >table.csv
    moves 'rotate file=table.csv degrees=true ! translate offset=[[0,-8.5,0]]' -0
    json ".t - $t | fabs < 1e-12"
    moves 'rotate times=0,1 angles=0,90 degrees=true ! translate offset=[[0,-8.5,0]]' -0
    json ".t - $t | fabs < 1e-12"
    refuses 't,j [rad]\n0,0\n1,1\n' "column 2 is in rad, but degrees is true" 'rotate file=table.csv degrees=true'
    refuses 't,j [mm]\n0,0\n1,1\n' "column 2 is in 'mm'; allowed are rad, deg and °" 'rotate file=table.csv'
    refuses 't,j [gon]\n0,0\n1,1\n' "column 2 is in 'gon'" 'rotate file=table.csv'
    fails 4 "degrees: belongs to a table" "$IMPINGE" pair sphere 'sphere ! rotate rate=1 degrees=true'
}

@test "lengths and times in a head are converted to the scene's, which must be known" {
    printf 't,x,y,z\n0,0,0,0\n1,-9,0,0\n' >table.csv
    moves 'translate file=table.csv' -0
    local t
    t=$(jq .t <<<"$output")
    printf 't [ms],x [mm],y [mm],z [cm]\n0,0,0,0\n1000,-9000,0,0\n' >table.csv
    moves 'translate file=table.csv scene_unit=m' -0
    json ".t - $t | fabs < 1e-12"
    printf 't [min],x [m],y,z\n0,0,0,0\n1,-0.009,0,0\n' >table.csv
    moves 'translate file=table.csv scene_unit=mm' -0
    json "(.t - 60 * $t | fabs) < 1e-9 and .time == [0, 60]"
    refuses 't,x [mm],y,z\n0,0,0,0\n1,0,0,0\n' "column 2 is in mm, but the scene's unit is not known; give scene_unit"
    refuses 't,x [kg],y,z\n0,0,0,0\n1,0,0,0\n' "column 2 is in 'kg'; allowed are m, cm, mm" 'translate file=table.csv scene_unit=m'
    refuses 't [deg],x,y,z\n0,0,0,0\n1,0,0,0\n' "column 1 is in 'deg'; allowed are s, ms"
    refuses 't,x,y,z\n0,0,0,0\n1,0,0,0\n' "scene_unit: found 'furlong'; allowed are m, cm, mm" \
        'translate file=table.csv scene_unit=furlong'
    fails 4 "scene_unit: belongs to a file" "$IMPINGE" pair sphere 'sphere ! translate velocity=1,0,0 scene_unit=m'
}

@test "reading a table ends with --max-seconds and --max-bytes" {
    printf '%d,0,0,0\n' {1..100000} >part.csv
    for _ in {1..15}; do cat part.csv; done >table.csv # 0.4 s; the least limit is 0.1 s
    local limit
    for limit in 'seconds 0.001' 'bytes 4M'; do
        # shellcheck disable=SC2086 # words of the command
        run -3 --separate-stderr "$IMPINGE" pair sphere 'sphere center=9,0,0 ! translate file=table.csv' \
            --max-$limit --isolate all --json
        json ".error | contains(\"max_${limit% *} is not enough to read this\")"
    done
}
