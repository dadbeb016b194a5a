# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

# The part of JSON Schema that tools/schema uses. Input: a value. $schema: the schema, in an array.
# Output: one line for each fault, nothing for a valid value. A keyword unknown here is a fault.

def kind:
    if type == "number" and floor == . then ["number", "integer"] else [type] end;

def faults($s; $where):
    . as $value |
    def fault(text): "\($where): \(text), not \($value | tojson | .[:80])";
    $s | to_entries[]
    | .key as $key | .value as $rule
    | $value
    | if $key == "$ref" then
        faults($schema[0]["$defs"][$rule | ltrimstr("#/$defs/")] // {unknown_ref: $rule}; $where)
      elif $key == "type" then
        if any(kind[]; IN(([$rule] | flatten)[])) then empty else fault("type \($rule | tojson)") end
      elif $key == "const" then if . == $rule then empty else fault("const \($rule)") end
      elif $key == "enum" then if IN($rule[]) then empty else fault("one of \($rule | tojson)") end
      elif $key == "minimum" then
        if type != "number" or . >= $rule then empty else fault("at least \($rule)") end
      elif $key == "exclusiveMinimum" then
        if type != "number" or . > $rule then empty else fault("more than \($rule)") end
      elif $key == "minItems" then
        if type != "array" or length >= $rule then empty else fault("\($rule) items or more") end
      elif $key == "maxItems" then
        if type != "array" or length <= $rule then empty else fault("\($rule) items or fewer") end
      elif $key == "items" then
        if type != "array" then empty
        else to_entries[] | "\($where)/\(.key)" as $at | .value | faults($rule; $at) end
      elif $key == "required" then
        if type != "object" then empty
        else ($rule - keys)[] as $k | fault("needs the key \($k)") end
      elif $key == "properties" then
        if type != "object" then empty
        else to_entries[] | select($rule[.key]) | "\($where)/\(.key)" as $at
            | $rule[.key] as $r | .value | faults($r; $at) end
      elif $key == "additionalProperties" then
        if type != "object" then empty
        else (keys - ($s.properties // {} | keys))[] as $k
            | if $rule == false then fault("has no key \($k)")
              else $value[$k] | faults($rule; "\($where)/\($k)") end end
      elif $key == "oneOf" or $key == "anyOf" then
        [$rule[] as $r | [$value | faults($r; $where)]] as $tries
        | ($tries | map(select(length == 0)) | length) as $fits
        | if $fits == 1 or ($key == "anyOf" and $fits > 0) then empty
          else fault("\($key), but \($fits) fit"), ($tries | min_by(length)[]) end
      elif $key | IN("$schema", "title", "description", "$defs") then empty
      else "\($where): the schema has the unknown keyword \($key)" end;

faults($schema[0]; "")
